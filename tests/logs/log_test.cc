// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "logs/format/mcap.h"
#include "logs/messages/scoria.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

std::string ReadAll(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Writes `count` messages in small chunks and returns the file.
void WriteSample(const std::filesystem::path& path, int count) {
  McapWriter writer(path, 2000);
  writer.AddMetadata("note", {{"key", "value"}});
  const auto channel =
      writer.AddChannel("/event", msg::Event::kTypeName, SchemaWriter::SchemaOf<msg::Event>());
  Bytes bytes;
  for (int i = 0; i < count; ++i) {
    msg::Event event{i, "kind", std::string(static_cast<std::size_t>(i % 40), 'x')};
    EncodeCdr(event, bytes);
    writer.Write(channel, 1000 * i, bytes);
  }
  writer.Close();
}

TEST(Cdr, LayoutFollowsTheRos2WireFormat) {
  msg::ContactState message;
  message.header.stamp = {7, 9};
  message.header.frame_id = "ab";
  message.ground_contact_force = {1.0, 2.0, 3.0, 4.0};
  Bytes bytes;
  EncodeCdr(message, bytes);
  // 4 encapsulation, 4 + 4 stamp, 4 + 3 string with terminator, 1 padding to 8, 4 doubles.
  ASSERT_EQ(bytes.size(), 4u + 8u + 7u + 1u + 32u);
  EXPECT_EQ(bytes[1], std::byte{1});  // little endian
  EXPECT_EQ(bytes[4], std::byte{7});
  EXPECT_EQ(bytes[12], std::byte{3});
  EXPECT_EQ(bytes[19], std::byte{0});  // padding is zero: equal messages are equal bytes
}

TEST(Cdr, EveryFieldSurvivesTheRoundTrip) {
  msg::ControllerInput input;
  input.step = 12345678901;
  input.q_rad[11] = -0.25;
  input.pattern = 2;
  input.wbc_fault = 3;
  Bytes bytes;
  EncodeCdr(input, bytes);
  auto back = DecodeCdr<msg::ControllerInput>(bytes);
  FieldLister a, b;
  input.Serialize(a);
  back.Serialize(b);
  EXPECT_EQ(a.fields(), b.fields());
  EXPECT_ANY_THROW((void)DecodeCdr<msg::ControllerInput>(std::span(bytes).first(bytes.size() / 2)));
}

TEST(Cdr, LongStringsFindRoom) {
  msg::Event event{1, "kind", std::string(100000, 'y')};
  Bytes bytes;
  EncodeCdr(event, bytes);
  EXPECT_EQ(DecodeCdr<msg::Event>(bytes).detail.size(), 100000u);
}

TEST(Schema, NestedTypesFollowOnce) {
  const std::string schema = SchemaWriter::SchemaOf<msg::QuadState>();
  EXPECT_EQ(schema.find("std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"), 0u)
      << schema;
  EXPECT_NE(
      schema.find("bool[4] foot_contact\nfloat64[12] ground_contact_force\nbool belly_contact\n"),
      std::string::npos);
  const auto first = schema.find("MSG: std_msgs/Header\n");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(schema.find("MSG: std_msgs/Header\n", first + 1), std::string::npos);
}

TEST(Mcap, WritesWhatItReads) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  WriteSample(path, 300);
  McapReader reader(path);
  int count = 0;
  const std::string problem = reader.ForEachMessage([&](const McapReader::Message& m) {
    EXPECT_EQ(m.channel.topic, "/event");
    EXPECT_EQ(m.channel.type_name, "scoria_msgs/msg/Event");
    EXPECT_EQ(m.time_ns, 1000 * count);
    EXPECT_EQ(DecodeCdr<msg::Event>(m.data).step, count);
    ++count;
    return true;
  });
  EXPECT_EQ(problem, "");
  EXPECT_EQ(count, 300);
  EXPECT_EQ(reader.ReadMetadata().at("note").at("key"), "value");
}

TEST(Mcap, CutAnywhereItReadsToItsLastWholeChunk) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap", cut = folder.path() / "cut.mcap";
  WriteSample(path, 200);
  const std::string whole = ReadAll(path);
  int last = 0;
  for (std::size_t size = 8; size < whole.size(); ++size) {
    std::ofstream(cut, std::ios::binary) << whole.substr(0, size);
    int count = 0;
    const std::string problem = McapReader(cut).ForEachMessage([&](const McapReader::Message& m) {
      EXPECT_EQ(DecodeCdr<msg::Event>(m.data).step, count++);
      return true;
    });
    EXPECT_GE(count, last) << "cut at " << size;  // more bytes never mean fewer messages
    last = count;
    EXPECT_TRUE(count == 200 || problem.find("cut off at byte") != std::string::npos) << problem;
  }
  EXPECT_EQ(last, 200);
}

TEST(Mcap, DamageIsNamedAndWhatPrecedesItIsRead) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  WriteSample(path, 300);
  std::string bytes = ReadAll(path);
  const std::size_t inside_a_chunk = bytes.size() / 6;
  bytes[inside_a_chunk] = static_cast<char>(bytes[inside_a_chunk] ^ 0x55);
  std::ofstream(path, std::ios::binary) << bytes;
  int count = 0;
  const std::string problem =
      McapReader(path).ForEachMessage([&](const McapReader::Message&) { return ++count > 0; });
  EXPECT_NE(problem, "");
  EXPECT_LT(count, 300);
  std::ofstream(path, std::ios::binary) << "not a log at all";
  EXPECT_THROW(McapReader{path}, std::runtime_error);
}

TEST(Mcap, AttachmentsTravelUnchanged) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  Bytes data(100000);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::byte>(i * i);
  {
    McapWriter writer(path);
    writer.AddMetadata("before", {});
    writer.AddAttachment({"ground.zst", "application/zstd", data});
    writer.AddMetadata("after", {{"key", "value"}});
  }
  const McapReader reader(path);
  const auto found = reader.ReadAttachment("ground.zst");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->media_type, "application/zstd");
  EXPECT_EQ(found->data, data);
  EXPECT_FALSE(reader.ReadAttachment("other").has_value());
  EXPECT_EQ(reader.ReadMetadata().at("after").at("key"), "value");
  EXPECT_TRUE(reader.IsWhole());

  std::string bytes = ReadAll(path);
  bytes[bytes.find("application/zstd") + 5000] ^= 1;
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    (void)McapReader(path).ReadAttachment("ground.zst");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(": wrong checksum"), std::string::npos) << e.what();
  }
  std::filesystem::resize_file(path, 5000);
  EXPECT_FALSE(McapReader(path).IsWhole());
  EXPECT_FALSE(McapReader(path).ReadAttachment("ground.zst").has_value());
}

/// The size that a chunk claims is no reason to take memory.
TEST(Mcap, ChunkThatClaimsTooMuchIsRefused) {
  const test::TemporaryFolder folder;
  const auto path = folder.path() / "a.mcap";
  WriteSample(path, 300);
  const std::string whole = ReadAll(path);
  const std::size_t chunk = whole.find("zstd") - 4 - 4 - 8;  // before: length of the word, checksum
  for (const std::uint64_t size :
       {std::uint64_t{1} << 20, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    std::string bytes = whole;
    for (std::size_t i = 0; i < 8; ++i) bytes[chunk + i] = static_cast<char>(size >> (8 * i));
    std::ofstream(path, std::ios::binary) << bytes;
    const std::string problem =
        McapReader(path).ForEachMessage([](const McapReader::Message&) { return true; });
    EXPECT_NE(
        problem.find(size >> 20 > 1 ? "chunk claims more than 256 MiB" : "chunk has a wrong size"),
        std::string::npos)
        << problem;
  }
}

// Every file of the MCAP project's conformance suite that uses a chunk or plain messages must at
// least be readable.
TEST(Mcap, ReadsTheConformanceFiles) {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(
           std::filesystem::path(data) / "mcap" / "conformance")) {
    if (entry.path().extension() != ".mcap") continue;
    ++files;
    int messages = 0;
    EXPECT_EQ(McapReader(entry.path()).ForEachMessage([&](const McapReader::Message&) {
      return ++messages > 0;
    }),
              "")
        << entry.path();
    const bool has_message = entry.path().filename().string().find("Message") != std::string::npos;
    EXPECT_EQ(messages > 0, has_message) << entry.path();
  }
  EXPECT_GT(files, 0);
}

}  // namespace
}  // namespace scoria::logs
