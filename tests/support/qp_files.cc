// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/qp_files.h"

#include <cstdlib>
#include <string>

#include "controller/qp/sets/qp_file.h"
#include "controller/qp/solvers/riccati_ipm.h"
#include "controller/qp/solvers/tsid_nullspace.h"
#include "tests/support/qp_problems.h"

namespace scoria::test {

namespace fs = std::filesystem;

QpFolder::QpFolder(int records) {
  std::string pattern = (fs::temp_directory_path() / "scoria-qp-XXXXXX").string();
  path_ = mkdtemp(pattern.data());
  core::Rng rng(61, 0, core::Stream::kSensor);
  controller::RiccatiIpm ipm{controller::RiccatiIpmParams{}};
  controller::TsidNullspace nullspace;
  controller::QpFileWriter mpc(path_ / "mpc.bin", controller::QpFileShape::Ocp(6)),
      wbc(path_ / "wbc.bin", controller::QpFileShape::Tsid(controller::TsidVariables::kReduced));
  for (int i = 0; i < records; ++i) {
    const bool euler = i / 2 % 2 == 0;
    const controller::OcpQp ocp = SampleOcp(rng, euler);
    ipm.Reset();
    mpc.Write(controller::MakeRecord(ocp, ipm.Solve(ocp)));
    const controller::TsidProblem tsid = SampleTsid(rng, SampleStance(i));
    wbc.Write(controller::MakeRecord({tsid, nullspace.Solve(tsid)}));
  }
  mpc.Close();
  wbc.Close();
}

QpFolder::~QpFolder() { fs::remove_all(path_); }

}  // namespace scoria::test
