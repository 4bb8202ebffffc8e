// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/sets/qp_check.h"

#include "controller/qp/sets/qp_file.h"

namespace scoria::controller {
namespace {

KktResidual CheckRecord(QpFileReader& reader, int index) {
  if (reader.is_ocp()) {
    const OcpRecord r = reader.ReadOcp(index);
    return CalcKkt(r.qp, r.point);
  }
  const DenseRecord r = reader.ReadDense(index);
  return CalcKkt(r.qp, r.point);
}

}  // namespace

std::vector<QpCheck> CheckQpFiles(const std::filesystem::path& folder) {
  std::vector<QpCheck> checks;
  for (const std::filesystem::path& file : FindQpFiles(folder)) {
    QpFileReader reader(file);
    QpCheck check;
    check.file = file.filename().string();
    check.exact = !reader.is_ocp();
    check.records = reader.size();
    for (int i = 0; i < reader.size(); ++i) check.Worsen(CheckRecord(reader, i));
    checks.push_back(check);
  }
  return checks;
}

}  // namespace scoria::controller
