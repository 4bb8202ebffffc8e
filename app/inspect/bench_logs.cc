// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/bench_logs.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "core/rng.h"
#include "core/stopwatch.h"
#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "logs/format/sqlite.h"
#include "logs/format/temporary_folder.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerMB = 1e6;
constexpr std::int64_t kStep_ns = 100'000;
/// Sizes of messages, of as many topics: an IMU sample, joints, a robot's state, a command.
constexpr std::size_t kSizes[] = {332, 600, 1260, 100, 324, 48};

/// Doubles that change slowly, with noise in the half of their bits.
logs::Bytes MakeMessage(std::size_t size, std::int64_t tick, core::Rng& rng) {
  constexpr double kPerTick_rad = 1e-3;
  logs::Bytes bytes(size);
  for (std::size_t at = 0; at + sizeof(double) <= size; at += sizeof(double)) {
    const double value =
        std::sin(kPerTick_rad * static_cast<double>(tick) + static_cast<double>(at));
    const std::uint32_t noise = rng.NextU32();
    std::memcpy(bytes.data() + at, &value, sizeof value);
    std::memcpy(bytes.data() + at, &noise, sizeof noise);
  }
  return bytes;
}

void WriteMcap(const fs::path& path, logs::McapCompression compression, double bytes) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  logs::McapWriter writer(path, 1 << 20, compression);
  std::vector<std::uint16_t> channels;
  for (const std::size_t size : kSizes)
    channels.push_back(writer.AddChannel(fmt::format("/topic_{}", size), "pkg/msg/Type", ""));
  std::int64_t tick = 0;
  for (double done = 0.0; done < bytes; ++tick) {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      writer.Write(channels[i], kStep_ns * tick, MakeMessage(kSizes[i], tick, rng));
      done += static_cast<double>(kSizes[i]);
    }
  }
  writer.Close();
}

/// SQLite makes the messages itself, all noise: nothing in a bag depends on what they hold.
void WriteDb3(const fs::path& path, double bytes) {
  const logs::SqliteDatabase database(path, logs::SqliteDatabase::Mode::kCreate);
  database.Run("PRAGMA synchronous = OFF");
  database.Run(
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL)");
  database.Run(
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
  database.Run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  std::size_t all = 0;
  std::string sizes;
  for (const std::size_t size : kSizes) {
    database.Run(
        fmt::format("INSERT INTO topics VALUES ({0}, '/topic_{0}', 'pkg/msg/Type', 'cdr')", size));
    all += size;
    sizes += fmt::format("{}({}, {})", sizes.empty() ? "" : ", ", sizes.size(), size);
  }
  const auto ticks = static_cast<std::int64_t>(bytes / static_cast<double>(all));
  database.Run(fmt::format(
      "WITH RECURSIVE tick(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM tick WHERE i < {}), "
      "topic(place, size) AS (VALUES {}) "
      "INSERT INTO messages(topic_id, timestamp, data) "
      "SELECT size, i * {}, randomblob(size) FROM tick, topic",
      ticks, sizes, kStep_ns));
}

}  // namespace

double LogBenchmark::MBPerS() const {
  return static_cast<double>(message_bytes) / kBytesPerMB / (open_s + read_s);
}

LogBenchmark BenchmarkLog(const std::string& name, const fs::path& log) {
  constexpr int kPasses = 3;
  LogBenchmark best;
  for (int pass = 0; pass < kPasses; ++pass) {
    LogBenchmark b;
    b.name = name;
    const core::Stopwatch opening;
    const std::unique_ptr<logs::LogSource> source = logs::OpenLog(log);
    b.open_s = opening.seconds();
    const core::Stopwatch reading;
    source->ForEach({}, [&](const logs::LogMessage& m) {
      b.message_bytes += m.data.size();
      ++b.messages;
    });
    b.read_s = reading.seconds();
    if (pass == 0 || b.open_s + b.read_s < best.open_s + best.read_s) best = b;
  }
  if (fs::is_regular_file(log)) best.file_bytes = fs::file_size(log);
  return best;
}

std::vector<LogBenchmark> BenchmarkLogFormats(int megabytes) {
  const logs::TemporaryFolder folder;
  const fs::path log = folder.path() / "log";
  const double bytes = kBytesPerMB * megabytes;
  std::vector<LogBenchmark> all;
  for (const auto& [name, compression] : {std::pair{"mcap", logs::McapCompression::kNone},
                                          std::pair{"mcap_lz4", logs::McapCompression::kLz4},
                                          std::pair{"mcap_zstd", logs::McapCompression::kZstd}}) {
    WriteMcap(log, compression, bytes);
    all.push_back(BenchmarkLog(name, log));
  }
  fs::remove(log);
  WriteDb3(log, bytes);
  all.push_back(BenchmarkLog("db3", log));
  return all;
}

}  // namespace scoria::app
