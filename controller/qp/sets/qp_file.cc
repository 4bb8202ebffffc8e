// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/sets/qp_file.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "controller/qp/sets/qp_fields.h"
#include "core/demand.h"
#include "core/files.h"
#include "core/text.h"

namespace scoria::controller {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the file is");

constexpr std::array<std::pair<QpFileKind, std::string_view>, 3> kMagics = {
    {{QpFileKind::kOcp, "SRBDMPC1"},
     {QpFileKind::kTsidReduced, "WBCQPR01"},
     {QpFileKind::kTsidFull, "WBCQPF01"}}};
constexpr std::int32_t kVersion = 1;
constexpr std::size_t kMagicBytes = 8;

/// What follows the magic.
struct Header {
  std::int32_t version = kVersion, count = 0, d0 = 0, d1 = 0, d2 = 0, record = 0, meta = 0;
  std::array<std::int32_t, 7> spare{};
};
constexpr std::size_t kHeaderBytes = kMagicBytes + sizeof(Header);
static_assert(kHeaderBytes == 64);

[[noreturn]] void Fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

[[noreturn]] void Fail(const fs::path& file, int record, const std::string& what) {
  Fail(file, fmt::format("record {}: {}", record, what));
}

QpFileKind KindOf(const fs::path& file, std::string_view magic) {
  for (const auto& [kind, name] : kMagics) {
    if (name == magic) return kind;
  }
  Fail(file, fmt::format("not a QP set (magic \"{}\"; known: {}, {}, {})", core::Shown(magic),
                         kMagics[0].second, kMagics[1].second, kMagics[2].second));
}

void RequireSize(const fs::path& file, std::string_view name, int value, int low, int high) {
  if (value >= low && value <= high) return;
  Fail(file, fmt::format("header: {} is {}, {}", name, value,
                         low == high ? fmt::format("must be {}", low)
                                     : fmt::format("outside [{}, {}]", low, high)));
}

QpFileShape ShapeOf(const fs::path& file, QpFileKind kind, const Header& head) {
  if (head.version != kVersion) {
    Fail(file, fmt::format("version {} of the format; this program reads version {}", head.version,
                           kVersion));
  }
  const QpFileShape shape{kind, head.d0, head.d1, head.d2};
  if (kind == QpFileKind::kOcp) {
    const QpFileShape full = QpFileShape::Ocp(kMaxHorizon);
    RequireSize(file, "number of stages", head.d0, 1, kMaxHorizon);
    RequireSize(file, "number of states", head.d1, full.d1, full.d1);
    RequireSize(file, "number of forces", head.d2, full.d2, full.d2);
  } else {
    const int variables = QpFileShape::Tsid(kind == QpFileKind::kTsidFull ? TsidVariables::kFull
                                                                          : TsidVariables::kReduced)
                              .d0;
    RequireSize(file, "number of variables", head.d0, variables, variables);
    RequireSize(file, "rows of A", head.d1, 0, variables);
    RequireSize(file, "rows of C", head.d2, 0, DenseQp::kMaxRows);
  }
  RequireSize(file, "length of meta", head.meta, shape.meta(), shape.meta());
  RequireSize(file, "length of a record", head.record, shape.record(), shape.record());
  return shape;
}

/// A count among the meta numbers.
int CountOf(const fs::path& file, int record, const DenseRecord& r, std::size_t index,
            unsigned most) {
  const double value = r.meta[index];
  for (unsigned count = 0; count <= most; ++count) {
    if (value == count) return static_cast<int>(count);
  }
  Fail(file, record, fmt::format("meta[{}] is {}, not one of 0 to {}", index, value, most));
}

void Resize(DenseRecord& r, int variables, int equalities, int rows) {
  r.qp.H.resize(variables, variables);
  r.qp.A.resize(equalities, variables);
  r.qp.C.resize(rows, variables);
  for (DenseQp::Vector* v : {&r.qp.g, &r.qp.lb, &r.qp.ub}) v->resize(variables);
  for (DenseQp::RowVector* v : {&r.qp.l, &r.qp.u}) v->resize(rows);
  r.qp.b.resize(equalities);
  r.point.z.resize(variables);
  r.point.y.resize(equalities);
  r.point.of_rows.resize(rows);
  r.point.of_bounds.resize(variables);
}

/// What keeps a record from being a whole-body problem; empty if nothing does.
std::string Problem(const DenseRecord& r) {
  const TsidLayout layout = r.layout();
  if (layout.cone_rows > TsidProblem::kConeRows || layout.rows != r.qp.C.rows() ||
      layout.equalities != r.qp.A.rows()) {
    return fmt::format("{} equalities and {} rows of C do not fit the stance mask {}",
                       r.qp.A.rows(), r.qp.C.rows(), r.meta[DenseRecord::kStanceMask]);
  }
  const int first_cone = layout.full ? 0 : kNumJoints;
  for (int row = first_cone; row < layout.rows; ++row) {
    const bool low = r.qp.l[row] > -DenseQp::kNone, high = r.qp.u[row] < DenseQp::kNone;
    if (low == high) return fmt::format("row {} of C must have one bound", row);
  }
  return "";
}

}  // namespace

QpFileShape QpFileShape::Ocp(int horizon) noexcept {
  return {QpFileKind::kOcp, horizon, Vec12::SizeAtCompileTime, Vec12::SizeAtCompileTime};
}

QpFileShape QpFileShape::Tsid(TsidVariables variables) noexcept {
  const TsidLayout most = TsidLayout::OfFile(LegArray<bool>(true), variables);
  return {most.full ? QpFileKind::kTsidFull : QpFileKind::kTsidReduced, most.variables,
          most.equalities, most.rows};
}

int QpFileShape::meta() const noexcept {
  return static_cast<int>(kind == QpFileKind::kOcp ? OcpRecord::kMeta : DenseRecord::kMeta);
}

int QpFileShape::record() const noexcept {
  if (kind == QpFileKind::kOcp) {
    const int N = d0, per_input = kNumLegs + 2 * d1 * d1 + d1 + 3 * d2 + 2 * d2;
    return meta() + d1 + N * per_input + 4 * (N + 1) * d1;
  }
  return meta() + d0 * (d0 + 5) + d1 * (d0 + 2) + d2 * (d0 + 3);
}

QpFileReader::QpFileReader(const fs::path& file) : path_(file), in_(file, std::ios::binary) {
  std::array<char, kHeaderBytes> bytes{};
  in_.read(bytes.data(), bytes.size());
  if (!in_) Fail(file, "cannot read a QP set's header");
  const QpFileKind kind = KindOf(file, {bytes.data(), kMagicBytes});
  Header head;
  std::memcpy(&head, bytes.data() + kMagicBytes, sizeof head);
  shape_ = ShapeOf(file, kind, head);
  count_ = head.count;
  if (count_ <= 0) Fail(file, "holds no record");
  const std::uintmax_t size = fs::file_size(file),
                       needed = kHeaderBytes + sizeof(double) *
                                                   static_cast<std::uintmax_t>(count_) *
                                                   static_cast<std::uintmax_t>(shape_.record());
  if (size != needed) {
    Fail(file, fmt::format("{} records take {} bytes, the file has {}", count_, needed, size));
  }
  numbers_.resize(static_cast<std::size_t>(shape_.record()));
}

void QpFileReader::Load(int index) {
  SCORIA_DEMAND(index >= 0 && index < count_, "record {} of {}", index, count_);
  std::vector<char> bytes(numbers_.size() * sizeof(double));
  in_.seekg(static_cast<std::streamoff>(kHeaderBytes) +
            index * static_cast<std::streamoff>(bytes.size()));
  in_.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in_) Fail(path_, index, "cannot be read");
  std::memcpy(numbers_.data(), bytes.data(), bytes.size());
}

OcpRecord QpFileReader::ReadOcp(int index) {
  SCORIA_DEMAND(is_ocp(), "{} holds whole-body problems", path_.string());
  Load(index);
  OcpRecord r;
  r.qp.horizon = shape_.d0;
  QpFieldReader fields(numbers_);
  VisitOcp(fields, r);
  if (!fields.drifts()) Fail(path_, index, "A is not [1 F; 0 1] with F = [E 0; 0 dt]");
  r.qp.friction = r.meta[OcpRecord::kFriction];
  r.qp.f_min_N = r.meta[OcpRecord::kForceMin];
  r.qp.f_max_N = r.meta[OcpRecord::kForceMax];
  r.qp.start_force_N = r.meta[OcpRecord::kMass] * OcpRecord::kWeightPerMass_mps2;
  r.qp.forward_euler = r.meta[OcpRecord::kExactHold] == 0.0;
  return r;
}

DenseRecord QpFileReader::ReadDense(int index) {
  SCORIA_DEMAND(!is_ocp(), "{} holds problems of the MPC", path_.string());
  Load(index);
  DenseRecord r;
  std::copy_n(numbers_.begin(), DenseRecord::kMeta, r.meta.begin());
  const auto count = [&](std::size_t meta, unsigned most) {
    return CountOf(path_, index, r, meta, most);
  };
  (void)count(DenseRecord::kStanceMask, DenseRecord::kAllFeet);
  const int equalities = count(DenseRecord::kEqualities, static_cast<unsigned>(shape_.d1)),
            rows = count(DenseRecord::kRows, static_cast<unsigned>(shape_.d2));
  Resize(r, shape_.d0, equalities, rows);
  QpFieldReader fields(numbers_);
  VisitDense(fields, r, shape_);
  if (const std::string problem = Problem(r); !problem.empty()) Fail(path_, index, problem);
  return r;
}

QpFileWriter::QpFileWriter(const fs::path& file, const QpFileShape& shape)
    : path_(file), out_(file, std::ios::binary), shape_(shape) {
  PutHeader();
  Check();
}

QpFileWriter::~QpFileWriter() {
  if (out_.is_open()) Finish();
}

void QpFileWriter::PutHeader() {
  const auto magic = std::find_if(kMagics.begin(), kMagics.end(),
                                  [&](const auto& m) { return m.first == shape_.kind; });
  const Header head{kVersion,  count_,          shape_.d0,     shape_.d1,
                    shape_.d2, shape_.record(), shape_.meta(), {}};
  std::array<char, kHeaderBytes> bytes{};
  std::memcpy(bytes.data(), magic->second.data(), kMagicBytes);
  std::memcpy(bytes.data() + kMagicBytes, &head, sizeof head);
  out_.write(bytes.data(), bytes.size());
}

void QpFileWriter::Check() const {
  if (!out_) throw core::FileError(path_, "cannot write", errno);
}

void QpFileWriter::Put(std::span<const double> numbers) {
  SCORIA_DEMAND(numbers.size() == static_cast<std::size_t>(shape_.record()), "{} numbers",
                numbers.size());
  std::vector<char> bytes(numbers.size_bytes());
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  Check();
  ++count_;
}

void QpFileWriter::Write(const OcpRecord& record) {
  SCORIA_DEMAND(shape_ == QpFileShape::Ocp(record.qp.horizon), "{} stages", record.qp.horizon);
  QpFieldWriter fields;
  VisitOcp(fields, record);
  Put(fields.numbers());
}

void QpFileWriter::Write(const DenseRecord& record) {
  SCORIA_DEMAND(shape_.kind != QpFileKind::kOcp && record.qp.A.rows() <= shape_.d1 &&
                    record.qp.C.rows() <= shape_.d2,
                "{} and {} rows", record.qp.A.rows(), record.qp.C.rows());
  QpFieldWriter fields;
  VisitDense(fields, record, shape_);
  Put(fields.numbers());
}

void QpFileWriter::Finish() {
  out_.seekp(0);
  PutHeader();
  out_.close();
}

void QpFileWriter::Close() {
  Finish();
  Check();
}

std::vector<fs::path> FindQpFiles(const fs::path& folder) {
  if (!fs::is_directory(folder)) Fail(folder, "not a folder");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".bin") files.push_back(entry.path());
  }
  if (files.empty()) Fail(folder, "holds no .bin file");
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace scoria::controller
