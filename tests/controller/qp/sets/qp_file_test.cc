// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/sets/qp_file.h"

#include <cstdlib>
#include <cstring>

#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/support/qp_files.h"

namespace scoria::controller {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeaderBytes = 64, kCount = 12, kD0 = 16, kD1 = 20, kD2 = 24, kRecord = 28,
                      kMeta = 32;

template <class T>
void Overwrite(const fs::path& file, std::size_t at, T value) {
  std::string bytes = core::ReadText(file);
  std::memcpy(bytes.data() + at, &value, sizeof value);
  core::WriteText(file, bytes);
}

/// What reading the whole file says.
std::string Complaint(const fs::path& file) {
  try {
    QpFileReader reader(file);
    for (int i = 0; i < reader.size(); ++i) {
      if (reader.is_ocp()) {
        (void)reader.ReadOcp(i);
      } else {
        (void)reader.ReadDense(i);
      }
    }
  } catch (const std::runtime_error& e) {
    const std::string text = e.what(), name = file.string() + ": ";
    EXPECT_TRUE(text.starts_with(name)) << text;
    return text.substr(name.size());
  }
  return "";
}

void Copy(const fs::path& from, const fs::path& to) {
  QpFileReader reader(from);
  QpFileWriter writer(to, reader.shape());
  for (int i = 0; i < reader.size(); ++i) {
    if (reader.is_ocp()) {
      writer.Write(reader.ReadOcp(i));
    } else {
      writer.Write(reader.ReadDense(i));
    }
  }
  writer.Close();
}

TEST(QpFile, WhatIsReadIsWrittenAgainByteForByte) {
  const test::QpFolder folder(8);
  for (const fs::path& file : FindQpFiles(folder.path())) {
    const fs::path copy = folder.path() / "copy";
    Copy(file, copy);
    EXPECT_TRUE(core::ReadText(copy) == core::ReadText(file)) << file;
  }
}

// The spare numbers of the header are not kept.
TEST(QpFile, ReferenceSetsAreWrittenAgainByteForByte) {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const test::QpFolder folder(1);
  for (const fs::path& file : FindQpFiles(fs::path(data) / "qp")) {
    const fs::path copy = folder.path() / "copy";
    Copy(file, copy);
    const std::string expected = core::ReadText(file), actual = core::ReadText(copy);
    EXPECT_TRUE(actual.substr(0, kMeta + 4) == expected.substr(0, kMeta + 4)) << file;
    EXPECT_TRUE(actual.substr(kHeaderBytes) == expected.substr(kHeaderBytes)) << file;
  }
}

TEST(QpFile, WrongHeadersAreToldInWords) {
  const test::QpFolder folder(2);
  const fs::path file = folder.path() / "broken";
  const auto broken = [&](const char* from, std::size_t at, auto value) {
    fs::copy_file(folder.path() / from, file, fs::copy_options::overwrite_existing);
    Overwrite(file, at, value);
    return Complaint(file);
  };
  core::WriteText(file, "short");
  EXPECT_EQ(Complaint(file), "cannot read a QP set's header");
  EXPECT_EQ(broken("mpc.bin", 7, '\x01'),
            "not a QP set (magic \"SRBDMPC \"; known: SRBDMPC1, WBCQPR01, WBCQPF01)");
  EXPECT_EQ(broken("mpc.bin", 8, 2), "version 2 of the format; this program reads version 1");
  EXPECT_EQ(broken("mpc.bin", kD0, 21), "header: number of stages is 21, outside [1, 20]");
  EXPECT_EQ(broken("mpc.bin", kD1, 13), "header: number of states is 13, must be 12");
  EXPECT_EQ(broken("mpc.bin", kD2, 9), "header: number of forces is 9, must be 12");
  EXPECT_EQ(broken("wbc.bin", kD0, 42), "header: number of variables is 42, must be 30");
  EXPECT_EQ(broken("wbc.bin", kD1, -1), "header: rows of A is -1, outside [0, 30]");
  EXPECT_EQ(broken("wbc.bin", kD2, 65), "header: rows of C is 65, outside [0, 64]");
  EXPECT_EQ(broken("wbc.bin", kMeta, 15), "header: length of meta is 15, must be 16");
  EXPECT_EQ(broken("wbc.bin", kRecord, 1), "header: length of a record is 1, must be 2698");
  EXPECT_EQ(broken("wbc.bin", kCount, 0), "holds no record");
  EXPECT_EQ(broken("wbc.bin", kCount, 3), "3 records take 64816 bytes, the file has 43232");
}

TEST(QpFile, WrongRecordsAreToldInWords) {
  const test::QpFolder folder(2);
  const fs::path file = folder.path() / "broken";
  const auto broken = [&](const char* from, int number, double value) {
    fs::copy_file(folder.path() / from, file, fs::copy_options::overwrite_existing);
    Overwrite(file, kHeaderBytes + sizeof(double) * static_cast<std::size_t>(number), value);
    return Complaint(file);
  };
  const int drift = 20 + 12 + 6 * 4;  // of stage 0
  EXPECT_EQ(broken("mpc.bin", drift + 1, 0.5),
            "record 0: A is not [1 F; 0 1] with F = [E 0; 0 dt]");
  EXPECT_EQ(broken("wbc.bin", 3, 16.0), "record 0: meta[3] is 16, not one of 0 to 15");
  EXPECT_EQ(broken("wbc.bin", 4, 18.5), "record 0: meta[4] is 18.5, not one of 0 to 18");
  EXPECT_EQ(broken("wbc.bin", 5, -1.0), "record 0: meta[5] is -1, not one of 0 to 32");
  EXPECT_EQ(broken("wbc.bin", 3, 14.0),
            "record 0: 18 equalities and 32 rows of C do not fit the stance mask 14");
  EXPECT_EQ(broken("wbc.bin", 4, 15.0),
            "record 0: 15 equalities and 32 rows of C do not fit the stance mask 15");
  const int low = 16 + 30 * 31 + 18 * 31 + 32 * 30;
  EXPECT_EQ(broken("wbc.bin", low + 14, -1e20), "record 0: row 14 of C must have one bound");
}

TEST(QpFile, FoldersWithoutSetsAreToldInWords) {
  const test::QpFolder folder(1);
  const auto complaint = [](const fs::path& path) -> std::string {
    try {
      (void)FindQpFiles(path);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  };
  const fs::path empty = folder.path() / "empty", file = folder.path() / "mpc.bin";
  fs::create_directory(empty);
  EXPECT_EQ(complaint(empty), empty.string() + ": holds no .bin file");
  EXPECT_EQ(complaint(file), file.string() + ": not a folder");
}

TEST(QpFile, WhatCannotBeWrittenIsToldInWords) {
  const test::QpFolder folder(1);
  const fs::path missing = folder.path() / "no" / "mpc.bin";
  try {
    const QpFileWriter writer(missing, QpFileShape::Ocp(10));
    FAIL();
  } catch (const core::FileError& e) {
    EXPECT_EQ(std::string(e.what()),
              missing.string() + ": cannot write: no such file or directory");
  }
}

TEST(QpFile, ADiskThatIsFullShowsAtTheLatestWhenTheFileIsClosed) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const test::QpFolder folder(1);
  QpFileReader reader(folder.path() / "mpc.bin");
  const OcpRecord record = reader.ReadOcp(0);
  EXPECT_THROW(
      {
        QpFileWriter writer("/dev/full", reader.shape());
        writer.Write(record);
        writer.Close();
      },
      core::FileError);
}

}  // namespace
}  // namespace scoria::controller
