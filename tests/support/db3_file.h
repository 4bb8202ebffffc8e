// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

struct sqlite3;

/// rosbag2 bags as its recorders wrote them, right or wrong. Source: [Rosbag2].
namespace scoria::test {

/// What the tables of a bag have, by schema_version of its recorder.
enum class Db3Era {
  kFirst = 1,       // topics without offered_qos_profiles
  kQos = 2,         // with it
  kMetadata = 3,    // tables schema and metadata, too
  kDefinitions = 4  // table message_definitions and hashes, too
};

/// A bag that is open for writing. Errors: std::runtime_error.
class Db3File {
 public:
  Db3File(const std::filesystem::path& path, Db3Era era);

  void AddTopic(int id, const std::string& name, const std::string& type,
                const std::string& encoding = "cdr", const std::string& hash = "");
  void AddDefinition(const std::string& type, const std::string& encoding, const std::string& text,
                     const std::string& hash = "");
  void AddMessage(int topic, std::int64_t time_ns, const std::string& data);
  /// Any other change.
  void Run(const std::string& sql);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
  Db3Era era_;
};

/// Opens any database to run one statement.
void RunSql(const std::filesystem::path& path, const std::string& sql);

/// A zstd frame; as a stream's it does not say how large its content is.
[[nodiscard]] std::string Zstd(const std::string& content, bool says_size);

/// A frame of a few kB that stands for that many bytes, which it says or not.
[[nodiscard]] std::string ZstdBomb(std::uint64_t bytes, bool says_size);

}  // namespace scoria::test
