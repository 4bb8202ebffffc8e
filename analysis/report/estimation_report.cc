// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/estimation_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "core/robot/contact.h"

namespace scoria::analysis {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
using Row = std::vector<std::string>;

/// The columns of the sweep and the arm, then those given.
Row Header(const CampaignResults& results, std::initializer_list<const char*> names) {
  Row header;
  for (const Axis& axis : results.axes) header.push_back(axis.label);
  header.emplace_back("arm");
  header.insert(header.end(), names.begin(), names.end());
  return header;
}

Row RowStart(const Cell& cell) {
  Row row = cell.point;
  row.push_back(cell.arm);
  return row;
}

/// A dash where there is nothing to show.
std::string Number(bool any, double value, int digits) {
  return any && std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "–";
}

std::string Percent(std::uint64_t part, std::uint64_t whole, int digits) {
  return Number(whole > 0, 100.0 * static_cast<double>(part) / static_cast<double>(whole), digits);
}

std::string SegmentCount(const DriftSummary& d) {
  if (d.segments == 0) return fmt::format("0 ({} short)", d.short_segments);
  if (d.used_short) return fmt::format("{}, all short", d.segments);
  return d.short_segments == 0 ? std::to_string(d.segments)
                               : fmt::format("{} ({} short)", d.segments, d.short_segments);
}

Row EstimationRow(const Cell& cell) {
  const EstimationMetrics& m = cell.estimation;
  const DriftSummary d = SummariseDrift(m);
  const bool walked = d.segments > 0;
  Row row = RowStart(cell);
  row.push_back(SegmentCount(d));
  row.push_back(Number(walked, d.horizontal_pct, 2));
  row.push_back(Number(walked, d.vertical_pct, 2));
  row.push_back(Number(walked, d.yaw_deg_per_m, 3));
  for (const RelativePoseError& e : {m.rpe_1m, m.rpe_10m}) {
    row.push_back(Number(e.stretches > 0, 1e3 * e.horizontal_rms_m, 1) + " / " +
                  Number(e.stretches > 0, 1e3 * e.vertical_rms_m, 1));
  }
  row.push_back(Number(m.rows > 0, 1e3 * m.velocity_rmse_mps, 1));
  row.push_back(Number(m.rows > 0, kDegrees * m.roll_rmse_rad, 2));
  row.push_back(Number(m.rows > 0, kDegrees * m.pitch_rmse_rad, 2));
  row.push_back(Number(m.nees_rows > 0, m.nees_ratio, 2));
  row.push_back(Number(m.nis_dof > 0, m.nis_ratio, 2));
  row.push_back(Number(m.force_stance_rows > 0, m.force_stance_rmse_N, 1) + " / " +
                Number(m.force_swing_rows > 0, m.force_swing_rmse_N, 1));
  return row;
}

std::string Delays(const DelayHistogram& delays) {
  const bool any = delays.count() > 0;
  return Number(any, 1e3 * delays.Quantile(0.5), 0) + " / " +
         Number(any, 1e3 * delays.Quantile(0.95), 0);
}

/// Missed edges in % of the true ones, and false ones per hundred true ones.
std::string Mistakes(const EdgeQuality& q) {
  return Percent(q.missed, q.true_edges(), 1) + " / " + Percent(q.false_alarms, q.true_edges(), 1);
}

const char* TitleOf(ContactWord word) {
  constexpr std::array<const char*, kNumContactWords> kTitles = {
      "the one that counts", "foot sensor", "momentum observer", "gait plan"};
  return kTitles[static_cast<std::size_t>(word)];
}

std::string Area(const ContactMetrics& m, ContactWord word) {
  if (word == ContactWord::kSensor) return Number(true, m.sensor.Area(), 4);
  if (word == ContactWord::kObserver) return Number(true, m.observer.Area(), 4);
  return "–";
}

/// One line per source that ever spoke.
void AppendContactRows(const Cell& cell, std::vector<Row>& rows) {
  const ContactMetrics& m = cell.estimation.contact;
  if (!m.HasDetection()) return;
  for (const auto& [word, name] : EnumNames(ContactWord{})) {
    const ContactQuality& q = m.of(word);
    if (!q.spoke) continue;
    Row row = RowStart(cell);
    row.emplace_back(TitleOf(word));
    row.push_back(Number(true, 100.0 * q.Accuracy(), 2));
    row.push_back(Number(true, 100.0 * q.TruePositiveRate(), 2));
    row.push_back(Number(true, 100.0 * q.FalsePositiveRate(), 2));
    row.push_back(std::to_string(q.touchdown.true_edges()));
    row.push_back(Delays(q.touchdown.delays));
    row.push_back(Mistakes(q.touchdown));
    row.push_back(Delays(q.liftoff.delays));
    row.push_back(Mistakes(q.liftoff));
    row.push_back(Area(m, word));
    rows.push_back(std::move(row));
  }
}

Row TrustRow(const Cell& cell) {
  const ContactMetrics& m = cell.estimation.contact;
  Row row = RowStart(cell);
  for (const ContactSource source : {ContactSource::kSensor, ContactSource::kObserver,
                                     ContactSource::kGaitPhase, ContactSource::kTruth}) {
    row.push_back(Percent(m.counted_from[static_cast<std::size_t>(source)], m.leg_rows, 1));
  }
  const bool has_sensor = m.of(ContactWord::kSensor).spoke;
  row.push_back(has_sensor ? Percent(m.distrusted_rows, m.leg_rows, 2) : "–");
  row.push_back(has_sensor ? std::to_string(m.distrusted_times) : "–");
  return row;
}

/// The curves and working points of one arm, as pieces of a plot command.
class RocPlot {
 public:
  explicit RocPlot(Figure& figure) : figure_(figure) {}

  void AddArm(std::size_t index, const std::string& arm, const ContactMetrics& m) {
    AddCurve(index, arm + ", sensor", m.sensor, "sensor", 1);
    AddCurve(index, arm + ", observer", m.observer, "observer", 2);
    constexpr std::array<int, kNumContactWords> kSymbols = {13, 7, 9, 5};
    for (const auto& [word, name] : EnumNames(ContactWord{})) {
      const ContactQuality& q = m.of(word);
      if (!q.spoke || q.stance_rows == 0 || q.swing_rows == 0) continue;
      const std::string block = fmt::format("{}_word{}", name, index);
      figure_.Data(block, {{q.FalsePositiveRate(), q.TruePositiveRate()}});
      Append(fmt::format("${} u 1:2 w p pt {} ps 1 lc rgb '{}' notitle", block,
                         kSymbols[static_cast<std::size_t>(word)], ArmColour(index)));
    }
  }
  [[nodiscard]] bool has_curves() const { return has_curves_; }
  [[nodiscard]] const std::string& command() const { return command_; }

 private:
  void AddCurve(std::size_t index, const std::string& title, const Evidence& evidence,
                const char* name, int dash) {
    const std::vector<RocPoint> curve = evidence.Curve();
    if (curve.empty()) return;
    has_curves_ = true;
    std::vector<std::vector<double>> rows;
    for (const RocPoint& p : curve) rows.push_back({p.false_positive_rate, p.true_positive_rate});
    const std::string block = fmt::format("{}_curve{}", name, index);
    figure_.Data(block, rows);
    Append(fmt::format("${} u 1:2 w l lw 2 dt {} lc rgb '{}' t '{} (AUC {:.4f})'", block, dash,
                       ArmColour(index), Escape(title), evidence.Area()));
  }
  void Append(const std::string& piece) { command_ += (command_.empty() ? "" : ", ") + piece; }

  Figure& figure_;
  std::string command_;
  bool has_curves_ = false;
};

}  // namespace

void AddStateEstimation(const CampaignResults& results, const std::vector<Cell>& cells,
                        HtmlPage& page) {
  std::vector<Row> rows;
  for (const Cell& c : cells) {
    if (c.estimation.present) rows.push_back(EstimationRow(c));
  }
  if (rows.empty()) return;
  page.Heading("State estimation");
  page.Table(Header(results,
                    {"segments", "horizontal drift [%]", "vertical drift [%]", "yaw drift [deg/m]",
                     "RPE 1 m, horizontal / vertical [mm]", "RPE 10 m, horizontal / vertical [mm]",
                     "velocity RMSE [mm/s]", "roll RMSE [deg]", "pitch RMSE [deg]", "NEES / 5",
                     "NIS / dof", "foot force RMSE, stance / swing [N]"}),
             rows);
  page.Note(fmt::format(
      "Estimate against truth. Drift: medians of the magnitudes at the end of segments between "
      "placements and falls, in % of the way; short segments (below {:.0f} m) are left out where "
      "there are longer ones. RPE: root mean square over stretches of the path. NEES / 5 and NIS / "
      "dof are 1 for a consistent filter, above for an overconfident one.",
      kMinSegment_m));
}

void AddContactDetection(const CampaignResults& results, const std::vector<Cell>& cells,
                         HtmlPage& page) {
  std::vector<Row> rows, trust;
  for (const Cell& c : cells) {
    AppendContactRows(c, rows);
    if (c.estimation.contact.HasDetection()) trust.push_back(TrustRow(c));
  }
  if (rows.empty()) return;
  page.Heading("Contact detection");
  page.Table(
      Header(results, {"source", "accuracy [%]", "stance seen [%]", "swing called stance [%]",
                       "true touchdowns", "touchdown delay, median / 95 % [ms]",
                       "touchdowns missed / false [%]", "lift-off delay, median / 95 % [ms]",
                       "lift-offs missed / false [%]", "AUC"}),
      rows);
  page.Paragraph("Whose word counted, and how often the foot sensors were distrusted:");
  page.Table(Header(results, {"sensor [% of the time]", "observer [%]", "gait plan [%]",
                              "truth [%]", "sensor distrusted [% of the time]", "times"}),
             trust);
  page.Note(
      "Against contact of more than 5 N in the simulator. Accuracy and AUC outside ±15 ms of the "
      "true edges; contacts and gaps below 10 ms are no edges to be reported. Delays are negative "
      "where a source was early. Missed and false edges in % of the true ones.");
}

std::vector<CaptionedFigure> ContactFigures(const CampaignResults& results) {
  Figure figure("contact_roc", "Contact detection", 1000, 520);
  RocPlot plot(figure);
  for (std::size_t a = 0; a < results.arms.size(); ++a)
    plot.AddArm(a, results.arms[a], PoolCell(results, results.arms[a], {}).estimation.contact);
  if (!plot.has_curves()) return {};
  figure.Line("set multiplot layout 1,2; set clip two");
  figure.Line(
      "set xlabel 'swing called stance (false positive rate)'; set ylabel 'stance seen (true "
      "positive rate)'");
  figure.Line("set key bottom right; set title 'Receiver operating characteristic'");
  figure.Line("plot [0:1][0:1] " + plot.command());
  figure.Line("unset key; set title 'its corner'");
  figure.Line("plot [0:0.1][0.9:1] " + plot.command());
  figure.Line("unset multiplot");
  std::vector<CaptionedFigure> figures;
  figures.push_back(
      {std::move(figure),
       "Rows outside ±15 ms of the true edges, pooled over the sweep. Lines: threshold on the "
       "sensor's counts (solid) and on the observer's probability (dashed). Points: the words "
       "themselves, with their hysteresis: sensor (disc), observer (triangle), gait plan (square), "
       "the one that counts (diamond)."});
  return figures;
}

}  // namespace scoria::analysis
