// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/sets/qp_check.h"

#include <gtest/gtest.h>

#include "controller/qp/sets/qp_file.h"
#include "tests/support/qp_files.h"

namespace scoria::controller {
namespace {

TEST(QpCheck, OneDisturbedRecordOfManySpoilsItsFileAlone) {
  const test::QpFolder folder(8);
  std::vector<QpCheck> checks = CheckQpFiles(folder.path());
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0].file, "mpc.bin");
  EXPECT_EQ(checks[1].file, "wbc.bin");
  for (const QpCheck& check : checks) {
    EXPECT_EQ(check.records, 8);
    EXPECT_TRUE(check.Holds()) << check.file;
  }
  EXPECT_FALSE(checks[0].exact);
  EXPECT_TRUE(checks[1].exact);

  std::vector<DenseRecord> records;
  {
    QpFileReader reader(folder.path() / "wbc.bin");
    for (int i = 0; i < reader.size(); ++i) records.push_back(reader.ReadDense(i));
  }
  records[5].point.z[1] += 1e-3;
  QpFileWriter writer(folder.path() / "wbc.bin", QpFileShape::Tsid(TsidVariables::kReduced));
  for (const DenseRecord& record : records) writer.Write(record);
  writer.Close();
  checks = CheckQpFiles(folder.path());
  EXPECT_TRUE(checks[0].Holds());
  EXPECT_FALSE(checks[1].Holds());
}

}  // namespace
}  // namespace scoria::controller
