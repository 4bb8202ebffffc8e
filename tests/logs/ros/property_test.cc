// SPDX-License-Identifier: BSD-3-Clause
// Random types and random messages of them, written by the tests' own encoder in every encoding.
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "logs/ros/check_message.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/idl_parser.h"
#include "logs/ros/message_error.h"
#include "logs/ros/visit_leaves.h"
#include "tests/logs/ros/cdr_writer.h"
#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

using test::CdrWriter;

/// splitmix64: the tests' own, the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }
  std::size_t Below(std::size_t n) { return static_cast<std::size_t>(Next() % n); }

 private:
  std::uint64_t state_;
};

const std::vector<std::string> kPrimitives = {"bool",   "int8",    "uint8",   "int16",
                                              "uint16", "int32",   "uint32",  "int64",
                                              "uint64", "float32", "float64", "string"};

/// Types T0 to T3 of a package; each uses only those behind it.
std::vector<MessageDefinition> RandomTypes(Dice& dice) {
  constexpr std::size_t kTypes = 4;
  std::vector<MessageDefinition> types(kTypes);
  for (std::size_t t = 0; t < kTypes; ++t) {
    types[t].name = fmt::format("pkg/msg/T{}", t);
    const std::size_t fields = dice.Below(7);
    for (std::size_t i = 0; i < fields; ++i) {
      FieldDefinition field;
      field.name = fmt::format("f{}", i);
      const bool is_struct = t + 1 < kTypes && dice.Below(3) == 0;
      field.type = is_struct ? fmt::format("pkg/msg/T{}", t + 1 + dice.Below(kTypes - 1 - t))
                             : kPrimitives[dice.Below(kPrimitives.size())];
      field.multiplicity = static_cast<Multiplicity>(dice.Below(3));
      if (field.multiplicity == Multiplicity::kArray) field.count = 1 + dice.Below(3);
      if (field.multiplicity == Multiplicity::kSequence) field.count = dice.Below(2) * 4;
      if (field.type == "string") field.string_bound = dice.Below(2) * 12;
      types[t].fields.push_back(field);
    }
  }
  return types;
}

std::string MsgType(const FieldDefinition& f) {
  std::string text = f.type;
  if (f.string_bound > 0) text += fmt::format("<={}", f.string_bound);
  if (f.multiplicity == Multiplicity::kArray) text += fmt::format("[{}]", f.count);
  if (f.multiplicity == Multiplicity::kSequence)
    text += f.count > 0 ? fmt::format("[<={}]", f.count) : "[]";
  return text;
}

std::string MsgSchema(const std::vector<MessageDefinition>& types) {
  std::string text;
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (t > 0) text += fmt::format("{}MSG: pkg/T{}\n", test::kLine, t);
    for (const FieldDefinition& f : types[t].fields) text += MsgType(f) + " " + f.name + "\n";
  }
  return text;
}

std::string IdlName(std::string type) {
  if (type.starts_with("pkg/")) return "pkg::msg::" + type.substr(8);
  if (type == "float32") return "float";
  if (type == "float64") return "double";
  return type == "bool" ? "boolean" : type;
}

std::string IdlSchema(const std::vector<MessageDefinition>& types) {
  std::string text;
  for (const MessageDefinition& type : types) {
    const std::string name = type.name.substr(8);
    text += fmt::format("{}IDL: {}\nmodule pkg {{ module msg {{ struct {} {{\n",
                        std::string(test::kLine).substr(1), type.name, name);
    if (type.fields.empty()) text += "uint8 structure_needs_at_least_one_member;\n";
    for (const FieldDefinition& f : type.fields) {
      std::string base = IdlName(f.type);
      if (f.string_bound > 0) base += fmt::format("<{}>", f.string_bound);
      if (f.multiplicity == Multiplicity::kSequence) {
        base = f.count > 0 ? fmt::format("sequence<{}, {}>", base, f.count)
                           : fmt::format("sequence<{}>", base);
      }
      text +=
          fmt::format("{} {}{};\n", base, f.name,
                      f.multiplicity == Multiplicity::kArray ? fmt::format("[{}]", f.count) : "");
    }
    text += "}; }; };\n";
  }
  return text;
}

/// Writes a random message and notes what is in it.
class RandomMessage {
 public:
  RandomMessage(const std::vector<MessageDefinition>& types, int encapsulation, Dice& dice)
      : types_(types), writer_(encapsulation), dice_(dice) {
    WriteStruct(types[0], "");
  }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return writer_.bytes(); }
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& values() const {
    return values_;
  }

 private:
  void WriteStruct(const MessageDefinition& type, const std::string& prefix) {
    const std::size_t size = writer_.is_delimited() ? writer_.BeginSized() : 0;
    if (type.fields.empty()) writer_.U8(0);
    for (const FieldDefinition& f : type.fields) WriteField(f, prefix + f.name);
    if (writer_.is_delimited()) writer_.EndSized(size);
  }

  void WriteField(const FieldDefinition& f, const std::string& path) {
    const bool is_struct = f.type.starts_with("pkg/");
    const bool has_size = writer_.is_xcdr2() && f.multiplicity != Multiplicity::kOne &&
                          (is_struct || f.type == "string");
    const std::size_t size = has_size ? writer_.BeginSized() : 0;
    std::size_t count = f.multiplicity == Multiplicity::kArray ? f.count : 1;
    if (f.multiplicity == Multiplicity::kSequence) {
      count = dice_.Below(5);
      writer_.U32(count);
    }
    for (std::size_t i = 0; i < count; ++i) {
      const std::string at =
          f.multiplicity == Multiplicity::kOne ? path : fmt::format("{}[{}]", path, i);
      if (is_struct) {
        WriteStruct(types_[static_cast<std::size_t>(f.type.back() - '0')], at + ".");
      } else {
        values_.emplace_back(at, WriteValue(f.type));
      }
    }
    if (has_size) writer_.EndSized(size);
  }

  std::string WriteValue(const std::string& type) {
    const std::uint64_t bits = dice_.Next();
    if (type == "string") {
      const std::string text(bits % 12, static_cast<char>('a' + bits / 12 % 26));
      writer_.Text(text);
      return text;
    }
    if (type == "bool") return writer_.U8(bits % 2), bits % 2 == 1 ? "true" : "false";
    if (type == "float32") {
      const auto value = static_cast<float>(static_cast<std::int64_t>(bits)) * 1e-9F;
      return writer_.F32(value), fmt::format("{}", value);
    }
    if (type == "float64") {
      const double value = static_cast<double>(static_cast<std::int64_t>(bits)) * 1e-9;
      return writer_.F64(value), fmt::format("{}", value);
    }
    const bool is_signed = type[0] == 'i';
    const std::size_t size = std::stoul(type.substr(is_signed ? 3 : 4)) / 8;
    const std::uint64_t kept = size == 8 ? bits : bits & ((std::uint64_t{1} << 8 * size) - 1);
    writer_.Unsigned(kept, size);
    if (!is_signed) return fmt::format("{}", kept);
    const int shift = static_cast<int>(64 - 8 * size);
    return fmt::format("{}", static_cast<std::int64_t>(kept << shift) >> shift);
  }

  const std::vector<MessageDefinition>& types_;
  CdrWriter writer_;
  Dice& dice_;
  std::vector<std::pair<std::string, std::string>> values_;
};

std::vector<std::pair<std::string, std::string>> Visited(const MessageType& type,
                                                         const std::vector<std::byte>& message) {
  std::vector<std::pair<std::string, std::string>> values;
  std::set<std::string> arrays;
  for (const LeafShape& leaf : ListLeaves(type)) {
    if (leaf.multiplicity != Multiplicity::kOne) arrays.insert(leaf.path);
  }
  const auto shape = [](std::string path) {
    for (std::size_t open = 0; (open = path.find('[', open)) != std::string::npos; ++open) {
      path.erase(open + 1, path.find(']', open) - open - 1);
    }
    return path;
  };
  VisitLeaves(type, message, [&](const LeafPath& path, const FieldView& view) {
    const std::string text = path.Text();
    const bool is_array = arrays.contains(shape(text));
    for (std::size_t i = 0; i < view.size(); ++i) {
      values.emplace_back(is_array ? fmt::format("{}[{}]", text, i) : text, view.Format(i));
    }
  });
  return values;
}

constexpr int kEncapsulations[] = {0x00, 0x01, 0x06, 0x07, 0x08, 0x09};

TEST(RandomMessages, AreReadAsTheyWereWritten) {
  Dice dice(1);
  for (int round = 0; round < 400; ++round) {
    const std::vector<MessageDefinition> types = RandomTypes(dice);
    const MessageType type = test::TypeOf(ParseRos2Msg(MsgSchema(types), "pkg/msg/T0", "msg"));
    ASSERT_EQ(type, test::TypeOf(ParseIdl(IdlSchema(types), "idl"))) << IdlSchema(types);
    for (const int encapsulation : kEncapsulations) {
      const RandomMessage message(types, encapsulation, dice);
      ASSERT_NO_THROW(CheckMessage(type, message.bytes())) << MsgSchema(types);
      ASSERT_EQ(Visited(type, message.bytes()), message.values()) << MsgSchema(types);
    }
  }
}

TEST(RandomMessages, ChosenFieldsAreReadWithoutTheRest) {
  Dice dice(2);
  for (int round = 0; round < 400; ++round) {
    const std::vector<MessageDefinition> types = RandomTypes(dice);
    const MessageType type = test::TypeOf(ParseRos2Msg(MsgSchema(types), "pkg/msg/T0", "msg"));
    for (const int encapsulation : kEncapsulations) {
      const RandomMessage message(types, encapsulation, dice);
      std::vector<std::string> paths, expected;
      for (const auto& [path, value] : message.values()) {
        if (dice.Below(4) != 0) continue;
        paths.push_back(path);
        expected.push_back(value);
      }
      FieldReader reader(type, paths);
      const auto views = reader.Read(message.bytes());
      for (std::size_t i = 0; i < paths.size(); ++i) {
        ASSERT_FALSE(views[i].IsAbsent()) << paths[i];
        ASSERT_EQ(views[i].Format(), expected[i]) << paths[i] << "\n" << MsgSchema(types);
      }
    }
  }
}

TEST(RandomMessages, CutAnywhereTheyAreNotWhole) {
  Dice dice(3);
  for (int round = 0; round < 100; ++round) {
    const std::vector<MessageDefinition> types = RandomTypes(dice);
    const MessageType type = test::TypeOf(ParseRos2Msg(MsgSchema(types), "pkg/msg/T0", "msg"));
    const RandomMessage message(types, kEncapsulations[dice.Below(6)], dice);
    for (std::size_t size = 0; size < message.bytes().size(); ++size) {
      // A copy of its own, so that a read beyond its end is seen by the address sanitizer.
      const std::vector<std::byte> cut(message.bytes().begin(),
                                       message.bytes().begin() + static_cast<long>(size));
      ASSERT_THROW(CheckMessage(type, cut), MessageError) << MsgSchema(types) << size;
    }
  }
}

TEST(RandomMessages, FlippedBytesAreReadOrRefused) {
  Dice dice(4);
  for (int round = 0; round < 300; ++round) {
    const std::vector<MessageDefinition> types = RandomTypes(dice);
    const MessageType type = test::TypeOf(ParseRos2Msg(MsgSchema(types), "pkg/msg/T0", "msg"));
    std::vector<std::byte> bytes =
        RandomMessage(types, kEncapsulations[dice.Below(6)], dice).bytes();
    for (int k = 0; k < 3; ++k)
      bytes[dice.Below(bytes.size())] = static_cast<std::byte>(dice.Next());
    try {
      Visited(type, bytes);
    } catch (const MessageError& error) {
      EXPECT_EQ(std::string(error.what()).find("pkg/msg/T0: "), 0u);
    }
  }
}

}  // namespace
}  // namespace scoria::logs
