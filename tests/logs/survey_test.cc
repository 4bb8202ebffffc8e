// SPDX-License-Identifier: BSD-3-Clause
#include "logs/survey.h"

#include <gtest/gtest.h>

#include "core/files.h"
#include "logs/format/cdr.h"
#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "logs/messages/scoria.h"
#include "tests/support/mcap_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kDate_ns = 1'700'000'000'000'000'000;

Bytes ContactAt(std::int64_t stamp_ns) {
  msg::ContactState message;
  message.header.stamp.sec = static_cast<std::int32_t>(stamp_ns / 1'000'000'000);
  message.header.stamp.nanosec = static_cast<std::uint32_t>(stamp_ns % 1'000'000'000);
  Bytes bytes;
  EncodeCdr(message, bytes);
  return bytes;
}

class Survey : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path log() const { return folder_.path() / "log.mcap"; }

  LogSurvey Read() const { return SurveyLog(*OpenLog(log()), TypeResolver()); }

  /// One topic of contacts, each (receive, header) time.
  LogSurvey SurveyOf(const std::vector<std::pair<std::int64_t, std::int64_t>>& times_ns) const {
    McapWriter writer(log());
    const std::uint16_t channel = writer.AddChannel("/contact_state", msg::ContactState::kTypeName,
                                                    SchemaWriter::SchemaOf<msg::ContactState>());
    for (const auto& [receive_ns, header_ns] : times_ns)
      writer.Write(channel, receive_ns, ContactAt(header_ns));
    writer.Close();
    return Read();
  }

 private:
  test::TemporaryFolder folder_;
};

// Bursts of a recorder: the header's clock is regular, that of the receiver is not.
TEST_F(Survey, TellsBothClocksOfAChannel) {
  std::vector<std::pair<std::int64_t, std::int64_t>> times_ns;
  for (int i = 0; i < 101; ++i)
    times_ns.emplace_back(kDate_ns + (i / 4 * 40 + i % 4) * kMs, kDate_ns + i * 10 * kMs);
  const LogSurvey survey = SurveyOf(times_ns);
  EXPECT_EQ(survey.messages, 101u);
  ASSERT_EQ(survey.channels.size(), 1u);
  const ChannelSurvey& channel = survey.channels[0];
  EXPECT_EQ(channel.messages, 101u);
  EXPECT_EQ(channel.receive.span, (LogSpan{kDate_ns, kDate_ns + 1000 * kMs}));
  EXPECT_EQ(channel.receive.rate_Hz(), 1000.0) << "within bursts";
  EXPECT_DOUBLE_EQ(*channel.receive.regular_share, 0.75);
  EXPECT_DOUBLE_EQ(channel.receive.longest_step_s, 0.037);
  ASSERT_TRUE(channel.header.has_value());
  EXPECT_EQ(channel.header_path, "header.stamp");
  EXPECT_EQ(channel.header->rate_Hz(), 100.0);
  EXPECT_EQ(channel.header->regular_share, 1.0);
  ASSERT_TRUE(channel.receive_after_header.has_value());
  EXPECT_DOUBLE_EQ(channel.receive_after_header->largest_s, 0.0);
  EXPECT_DOUBLE_EQ(channel.receive_after_header->smallest_s, -0.027);
  EXPECT_NE(channel.type.taken(), nullptr);
  EXPECT_EQ(channel.undecoded, 0u);
}

TEST_F(Survey, CountsStampsThatGoBackOrStandStill) {
  const LogSurvey survey = SurveyOf({{0 * kMs, 50 * kMs},
                                     {10 * kMs, 60 * kMs},
                                     {20 * kMs, 60 * kMs},
                                     {15 * kMs, 55 * kMs},
                                     {25 * kMs, 70 * kMs}});
  const ChannelSurvey& channel = survey.channels[0];
  EXPECT_EQ(channel.receive.backward, 1u);
  EXPECT_EQ(channel.receive.repeated, 0u);
  EXPECT_EQ(channel.receive.span, (LogSpan{0, 25 * kMs}));
  EXPECT_DOUBLE_EQ(*channel.receive.regular_share, 0.75);
  EXPECT_EQ(channel.header->backward, 1u);
  EXPECT_EQ(channel.header->repeated, 1u);
  EXPECT_EQ(survey.span, (LogSpan{0, 25 * kMs}));
}

TEST_F(Survey, ClocksOfOtherOriginsAreToldApartExactly) {
  std::vector<std::pair<std::int64_t, std::int64_t>> times_ns;
  for (int i = 0; i < 100; ++i) times_ns.emplace_back(kDate_ns + i * kMs + i % 3, i * kMs);
  const auto difference = SurveyOf(times_ns).channels[0].receive_after_header;
  EXPECT_DOUBLE_EQ(difference->median_s, 1e-9 * static_cast<double>(kDate_ns + 1));
}

TEST_F(Survey, OneMessageHasNoRate) {
  const ChannelSurvey channel = SurveyOf({{kMs, kMs}}).channels[0];
  EXPECT_FALSE(channel.receive.rate_Hz().has_value());
  EXPECT_FALSE(channel.receive.regular_share.has_value());
  EXPECT_EQ(channel.receive.span, (LogSpan{kMs, kMs}));
}

TEST_F(Survey, MessagesThatDoNotFitAreCountedAfterTheChoiceAsWell) {
  McapWriter writer(log());
  const std::uint16_t channel = writer.AddChannel("/contact_state", msg::ContactState::kTypeName,
                                                  SchemaWriter::SchemaOf<msg::ContactState>());
  for (int i = 0; i < 10; ++i) {
    Bytes message = ContactAt(i * kMs);
    if (i % 4 == 3) message.resize(message.size() - 9);
    writer.Write(channel, i * kMs, message);
  }
  writer.Close();
  const ChannelSurvey contact = Read().channels[0];
  EXPECT_EQ(contact.messages, 10u);
  EXPECT_EQ(contact.undecoded, 2u);
  EXPECT_NE(contact.first_undecoded.find("ground_contact_force"), std::string::npos)
      << contact.first_undecoded;
  EXPECT_EQ(contact.header->stamps, 8u);
}

TEST_F(Survey, WhatIsNotDecodedHasItsTimesAndTheReason) {
  core::WriteText(log(), test::McapFile(test::McapSchema(1, "pkg.Thing", "protobuf", "x") +
                                        test::McapChannel(1, 1, "/thing", "protobuf") +
                                        test::McapMessage(1, 1'000, "abc") +
                                        test::McapMessage(1, 3'000, "abcd")));
  const ChannelSurvey thing = Read().channels[0];
  EXPECT_EQ(thing.messages, 2u);
  EXPECT_EQ(thing.bytes, 7u);
  EXPECT_EQ(thing.receive.span, (LogSpan{1'000, 3'000}));
  EXPECT_FALSE(thing.header.has_value());
  EXPECT_EQ(thing.undecoded, 2u);
  EXPECT_EQ(thing.type.Report(), "encoding \"protobuf\" is not decoded (cdr is)");
}

}  // namespace
}  // namespace scoria::logs
