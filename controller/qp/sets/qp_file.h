// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "controller/qp/sets/qp_record.h"

namespace scoria::controller {

enum class QpFileKind { kOcp, kTsidReduced, kTsidFull };

/// Kind and sizes of the records of a file; all have the same. Format: docs/qp_format.md.
struct QpFileShape {
  QpFileKind kind = QpFileKind::kOcp;
  int d0 = 0, d1 = 0, d2 = 0;  // stages, states, forces; or variables, rows of A, rows of C
  bool operator==(const QpFileShape&) const = default;

  [[nodiscard]] static QpFileShape Ocp(int horizon) noexcept;
  [[nodiscard]] static QpFileShape Tsid(TsidVariables variables) noexcept;

  /// Numbers per record, of which the first are meta.
  [[nodiscard]] int record() const noexcept;
  [[nodiscard]] int meta() const noexcept;
};

/// A file of problems with their solutions, read record by record.
class QpFileReader {
 public:
  /// Errors: std::runtime_error that names the file and what is wrong.
  explicit QpFileReader(const std::filesystem::path& file);

  [[nodiscard]] const QpFileShape& shape() const noexcept { return shape_; }
  [[nodiscard]] bool is_ocp() const noexcept { return shape_.kind == QpFileKind::kOcp; }
  [[nodiscard]] int size() const noexcept { return count_; }

  /// @pre the file is of that kind, 0 ≤ index < size(). Errors: std::runtime_error that names file
  /// and record.
  [[nodiscard]] OcpRecord ReadOcp(int index);
  [[nodiscard]] DenseRecord ReadDense(int index);

 private:
  void Load(int index);

  std::filesystem::path path_;
  std::ifstream in_;
  QpFileShape shape_;
  int count_ = 0;
  std::vector<double> numbers_;  // of the record that was read last
};

/// Writes such a file. The number of records enters the header when it is closed.
class QpFileWriter {
 public:
  /// Errors: core::FileError, here and in all below.
  QpFileWriter(const std::filesystem::path& file, const QpFileShape& shape);
  ~QpFileWriter();
  QpFileWriter(const QpFileWriter&) = delete;
  QpFileWriter& operator=(const QpFileWriter&) = delete;

  /// @pre the record is of the file's kind and within its sizes.
  void Write(const OcpRecord& record);
  void Write(const DenseRecord& record);
  void Close();

 private:
  void PutHeader();
  void Put(std::span<const double> numbers);
  void Finish();
  void Check() const;

  std::filesystem::path path_;
  std::ofstream out_;
  QpFileShape shape_;
  int count_ = 0;
};

/// The .bin files of a folder, sorted. Errors: std::runtime_error if there are none.
[[nodiscard]] std::vector<std::filesystem::path> FindQpFiles(const std::filesystem::path& folder);

}  // namespace scoria::controller
