// SPDX-License-Identifier: BSD-3-Clause
#include "logs/row.h"

#include <gtest/gtest.h>

#include "logs/format/cdr.h"
#include "tests/support/rows.h"

namespace scoria::logs {
namespace {

Bytes Encode(RowMessage<ContactsRow> message) {
  Bytes bytes;
  EncodeCdr(message, bytes);
  return bytes;
}

TEST(Row, AbsentValuesStayAbsentInItsMessages) {
  RowMessage<ContactsRow> message{1.25, {}};
  message.group.contact = {true, false, true, true};
  message.group.source = {0, 1, 2, 3};
  message.group.observer = ObserverContact{{true, true, false, false}, {0.9, 0.8, 0.1, 0.0}};
  const auto back = DecodeCdr<RowMessage<ContactsRow>>(Encode(message));
  EXPECT_EQ(back.time_s, 1.25);
  EXPECT_EQ(back.group, message.group);
  EXPECT_FALSE(back.group.sensor.has_value());
  EXPECT_FALSE(back.group.f_F_W_N.has_value());
}

// As ROS writes what it may lack: a sequence with a bound, of no items.
TEST(Row, OptionalFieldsAreBoundedSequences) {
  EXPECT_EQ(SchemaWriter::SchemaOf<RowMessage<ContactsRow>>(),
            "float64 time_s\nbool[4] contact\nuint8[<=4] source\nfloat64[<=12] f_f_w_n\n"
            "scoria_msgs/SensorContact[<=1] sensor\nscoria_msgs/ObserverContact[<=1] observer\n" +
                std::string(80, '=') +
                "\nMSG: scoria_msgs/SensorContact\nbool[4] contact\nbool[4] healthy\n"
                "float64[4] counts\n" +
                std::string(80, '=') +
                "\nMSG: scoria_msgs/ObserverContact\nbool[4] contact\nfloat64[4] probability\n");
  // Encapsulation, time, four flags, four empty sequences.
  EXPECT_EQ(Encode({}).size(), 4u + 8u + 4u + 4u * 4u);
  RowMessage<ContactsRow> message;
  message.group.source = {1, 2, 3, 0};
  EXPECT_EQ(Encode(message).size(), 4u + 8u + 4u + 4u * 4u + 4u);
}

TEST(Row, SequenceOfAnotherLengthIsRefused) {
  RowMessage<ContactsRow> message;
  message.group.source = {1, 2, 3, 0};
  Bytes bytes = Encode(message);
  bytes[16] = std::byte{3};  // the length of source
  try {
    (void)DecodeCdr<RowMessage<ContactsRow>>(bytes);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "a field of 4 or no values has 3");
  }
}

TEST(Row, ListingNamesWhatIsAbsent) {
  RowMessage<SolveTimesRow> message{2.0, {.mpc_s = 0.5}};
  FieldLister lister;
  message.Serialize(lister);
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"time_s", "2"}, {"mpc_s", "0.5"}, {"wbc_s", "none"}};
  EXPECT_EQ(lister.fields(), expected);
}

TEST(Row, GroupsHaveTopicsOfTheirOwn) {
  EXPECT_EQ(TopicOf(RowGroup::kTrueContacts), "/scoria/row/true_contacts");
  Row row;
  EXPECT_TRUE(GroupsOf(row).none());
  row.command.emplace();
  EXPECT_TRUE(GroupsOf(row)[static_cast<std::size_t>(RowGroup::kCommand)]);
  EXPECT_EQ(GroupsOf(row).count(), 1u);
  Row whole = test::WholeRow();
  EXPECT_TRUE(GroupsOf(whole).all());
  test::DropTruth(whole);
  EXPECT_FALSE(whole.truth || whole.true_joints || whole.true_contacts || whole.true_mass ||
               whole.energy || whole.ledger);
  EXPECT_TRUE(whole.episode && whole.measured && whole.estimate && whole.solve_times);
}

}  // namespace
}  // namespace scoria::logs
