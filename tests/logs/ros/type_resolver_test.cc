// SPDX-License-Identifier: BSD-3-Clause
#include "logs/ros/type_resolver.h"

#include <fstream>
#include <initializer_list>

#include <gtest/gtest.h>

#include "logs/ros/field_reader.h"
#include "tests/logs/ros/cdr_writer.h"
#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;
using test::CdrWriter;

/// A folder with files, gone with the object.
class Folder {
 public:
  explicit Folder(std::initializer_list<std::pair<const char*, const char*>> files) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = fs::temp_directory_path() / (std::string("scoria_msgs_") + test->name());
    fs::remove_all(path_);
    fs::create_directories(path_);
    for (const auto& [name, text] : files) {
      fs::create_directories((path_ / name).parent_path());
      std::ofstream(path_ / name) << text;
    }
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TypeChoice Resolve(const std::string& type, const std::vector<fs::path>& msg_paths = {}) {
  return TypeResolver(msg_paths).Resolve({type, "cdr", "", ""});
}

TypeChoice ResolveOwn(const std::string& type, const std::string& schema,
                      const std::string& encoding = "ros2msg") {
  return TypeResolver().Resolve({type, "cdr", encoding, schema});
}

TEST(TypeResolver, EveryBuiltInDefinitionIsAWholeType) {
  int types = 0;
  for (const ListedDefinitions& source : BuiltInDefinitions()) {
    EXPECT_EQ(source.name().find("built in"), 0u) << source.name();
  }
  for (const char* type : {"std_msgs/msg/Header",
                           "sensor_msgs/msg/Imu",
                           "sensor_msgs/msg/JointState",
                           "nav_msgs/msg/Odometry",
                           "geometry_msgs/msg/PoseStamped",
                           "tf2_msgs/msg/TFMessage",
                           "diagnostic_msgs/msg/DiagnosticArray",
                           "trajectory_msgs/msg/JointTrajectory",
                           "rcl_interfaces/msg/Log",
                           "rosgraph_msgs/msg/Clock",
                           "interfaces/msg/JointState",
                           "interfaces/msg/JointCmd",
                           "interfaces/msg/QuadState",
                           "interfaces/msg/ContactState",
                           "interfaces/msg/GaitState",
                           "interfaces/msg/GaitSequence",
                           "interfaces/msg/PositionSequence",
                           "interfaces/msg/WBCTarget",
                           "interfaces/msg/WBCReturn",
                           "interfaces/msg/MPCDiagnostics",
                           "interfaces/msg/ControllerInfo",
                           "interfaces/msg/QuadModel",
                           "interfaces/msg/BatteryState",
                           "interfaces/msg/QuadControlTarget",
                           "interfaces/msg/LegCmd",
                           "interfaces/msg/SimulationDisturbance",
                           "interfaces/msg/TrajectoryStatus",
                           "interfaces/msg/VectorSequence",
                           "unitree_go/msg/LowState",
                           "unitree_go/msg/LowCmd",
                           "unitree_go/msg/SportModeState",
                           "unitree_go/msg/WirelessController",
                           "go2_interfaces/msg/Go2State",
                           "vicon_receiver/msg/Position",
                           "spot_msgs/msg/FootStateArray",
                           "champ_msgs/msg/ContactsStamped",
                           "dls2_interface/msg/BlindState"}) {
    const TypeChoice choice = Resolve(type);
    ASSERT_NE(choice.taken(), nullptr) << type << ": " << choice.Report();
    EXPECT_EQ(choice.taken()->type.name(), type);
    ++types;
  }
  EXPECT_EQ(types, 37);
}

TEST(TypeResolver, SizesAreThoseThatRobotsSend) {
  // With the four-byte encapsulation; measured in recordings, and of [XTypes]' rules.
  const auto size = [](const std::string& type) {
    return 4 + Resolve(type).taken()->type.root().ExtentIn(CdrVersion::kXcdr1).value().at(0);
  };
  EXPECT_EQ(size("unitree_go/msg/LowState"), 1180u);
  EXPECT_EQ(size("unitree_go/msg/LowCmd"), 812u);
  EXPECT_EQ(size("unitree_go/msg/SportModeState"), 236u);
  EXPECT_EQ(size("interfaces/msg/GaitSequence"), 4u + 3185u);
  EXPECT_EQ(size("interfaces/msg/PositionSequence"), 4u + 1140u);
}

TEST(TypeResolver, HorizonsAreToldApartBySize) {
  for (const auto& [bytes, variant] :
       {std::pair(3185, "built in, N = 20"), std::pair(1705, "built in, N = 10")}) {
    TypeChoice choice = Resolve("interfaces/msg/GaitSequence");
    CdrWriter w(0x01);
    w.Bytes(0, static_cast<std::size_t>(bytes));
    choice.Show(w.bytes());
    ASSERT_NE(choice.taken(), nullptr) << choice.Report();
    EXPECT_EQ(choice.Report(), variant);
  }
}

std::vector<std::byte> Position(bool header) {
  CdrWriter w(0x01);
  if (header) w.U32(1764964008).U32(547).Text("vicon");
  for (int i = 0; i < 6; ++i) w.F32(0.1F);
  return w.F32(1).Text("Go2").Text("Go2").U32(77).Text("Pose").bytes();
}

TEST(TypeResolver, PositionWithAndWithoutHeader) {
  TypeChoice with = Resolve("vicon_receiver/msg/Position");
  with.Show(Position(true));
  EXPECT_EQ(with.Report(), "built in, with header");
  TypeChoice without = Resolve("vicon_receiver/msg/Position");
  without.Show(Position(false));
  EXPECT_EQ(without.Report(), "built in, without header");
  EXPECT_EQ(FieldReader(without.taken()->type, {"frame_number"}).Read(Position(false))[0].Int(),
            77);
}

TEST(TypeResolver, LayoutsOfGo2InterfacesAreToldApart) {
  const auto report = [](std::size_t bytes) {
    TypeChoice choice = Resolve("go2_interfaces/msg/Go2State");
    CdrWriter w(0x01);
    w.Bytes(0, bytes);
    choice.Show(w.bytes());
    return choice.Report();
  };
  EXPECT_EQ(report(164), "built in");
  EXPECT_EQ(report(156), "built in, int16 range_obstacle");
  EXPECT_EQ(report(172), "built in, float32 foot_force");
}

TEST(TypeResolver, EveryMessageMustFit) {
  TypeChoice choice = Resolve("interfaces/msg/BatteryState");
  choice.Show(CdrWriter(0x01).F32(28).F32(3).bytes());
  EXPECT_NE(choice.taken(), nullptr);
  EXPECT_FALSE(choice.IsSettled());
  choice.Show(CdrWriter(0x01).F32(28).F32(3).F32(1).bytes());
  EXPECT_EQ(choice.taken(), nullptr);
  EXPECT_EQ(choice.Report(),
            "no definition of interfaces/msg/BatteryState fits: built in: "
            "interfaces/msg/BatteryState: 4 of "
            "16 bytes are left behind the last field (at most 3 of padding are allowed)");
}

TEST(TypeResolver, TheBagsOwnDefinitionComesFirst) {
  TypeChoice choice = ResolveOwn("interfaces/BatteryState", "float32 voltage\nfloat32 current\n");
  choice.Show(CdrWriter(0x01).F32(28).F32(3).bytes());
  EXPECT_TRUE(choice.IsSettled());
  EXPECT_EQ(choice.Report(), "the bag");
  EXPECT_TRUE(choice.taken()->is_own);
}

TEST(TypeResolver, TheBagsOwnIsKeptWhereSomeMessagesFit) {
  TypeChoice choice = ResolveOwn("pkg/msg/Type", "float64 a");
  choice.Show(CdrWriter(0x01).F32(1).bytes());
  EXPECT_EQ(choice.taken(), nullptr);
  choice.Show(CdrWriter(0x01).F64(1).bytes());
  ASSERT_NE(choice.taken(), nullptr);
  EXPECT_EQ(
      choice.Report(),
      "the bag (1 of 2 messages do not fit it: pkg/msg/Type: a: 8 bytes are needed, 4 are left (at "
      "byte 4 of 8))");
}

TEST(TypeResolver, BytesThatTheBagsOwnLeavesOverAreSaid) {
  // As in rosbag2's own talker.db3, where the definition of Log is one field.
  TypeChoice choice = ResolveOwn("rcl_interfaces/msg/Log", "uint8 level");
  choice.Show(
      CdrWriter(0x01).U32(1).U32(2).U8(20).Text("n").Text("m").Text("f").Text("g").U32(5).bytes());
  EXPECT_EQ(
      choice.Report(),
      "the bag (bytes are left behind its last field in 1 of 1 messages); built in fits as well");
}

TEST(TypeResolver, AWrongDefinitionInTheBagGivesWayToTheOneThatFits) {
  TypeChoice choice =
      ResolveOwn("interfaces/msg/BatteryState", "float64 voltage\nfloat32 current\n");
  choice.Show(CdrWriter(0x01).F32(28).F32(3).bytes());
  EXPECT_EQ(choice.Report(), "built in");
}

TEST(TypeResolver, AnUnreadableDefinitionInTheBagIsSaid) {
  TypeChoice choice = ResolveOwn("interfaces/msg/BatteryState", "float32 voltage\nfloat32\n");
  choice.Show(CdrWriter(0x01).F32(28).F32(3).bytes());
  EXPECT_EQ(
      choice.Report(),
      "built in; the bag's definition of interfaces/msg/BatteryState:2: \"float32\": a type is "
      "followed by the name of a field");
}

TEST(TypeResolver, WhatABagLeavesOutIsBorrowed) {
  TypeChoice choice = ResolveOwn("pkg/msg/Type", "std_msgs/Header header\nint8 a");
  ASSERT_NE(choice.taken(), nullptr) << choice.Report();
  EXPECT_EQ(choice.Report(),
            "the bag, builtin_interfaces/msg/Time built in, std_msgs/msg/Header built in");
  EXPECT_FALSE(choice.taken()->is_own);
}

TEST(TypeResolver, ReadsIdlOfTheBagAlsoInOtherModules) {
  const char* idl = "module pkg { module msg { module dds_ { struct Type { double a; }; }; }; };";
  TypeChoice choice = ResolveOwn("pkg/msg/Type", idl, "ros2idl");
  choice.Show(CdrWriter(0x01).F64(1).bytes());
  EXPECT_EQ(choice.Report(), "the bag");
}

TEST(TypeResolver, OtherEncodingsAreRefusedInWords) {
  const TypeResolver resolver;
  EXPECT_EQ(resolver.Resolve({"test_msgs/msg/Arrays", "wrong_format", "ros2msg", ""}).Report(),
            "encoding \"wrong_format\" is not decoded (cdr is)");
  EXPECT_EQ(resolver.Resolve({"a/msg/B", "cdr", "omgidl", ""}).Report(),
            "schema encoding \"omgidl\" is not decoded (ros2msg and ros2idl are)");
  const TypeChoice service =
      resolver.Resolve({"a/srv/B_Event", "cdr", "ros2msg", "int64 a\n---\nint64 b\n"});
  EXPECT_EQ(service.taken(), nullptr);
  EXPECT_EQ(
      service.Report(),
      "the bag's definition of a/srv/B_Event:2: \"---\": a service or action is not one message");
  EXPECT_EQ(resolver.Resolve({"a/msg/B", "cdr", "", ""}).Report(),
            "no definition of a/msg/B in the bag, below --msg-path or built in");
}

TEST(TypeResolver, WideTextIsReadInTheWidthThatFits) {
  for (const std::size_t width : {std::size_t{4}, std::size_t{2}}) {
    TypeChoice choice = ResolveOwn("pkg/msg/Type", "wstring s\nint32 a");
    choice.Show(CdrWriter(0x01).WideText(U"", width).U32(1).bytes());  // tells nothing
    choice.Show(CdrWriter(0x01).WideText(U"abc", width).U32(1).bytes());
    EXPECT_EQ(choice.Report(), "the bag, wstring of " + std::to_string(width) + "-byte characters");
  }
}

TEST(TypeResolver, WhatElseFitsIsSaid) {
  TypeChoice choice = ResolveOwn("pkg/msg/Type", "wstring s\nint32 a");
  choice.Show(CdrWriter(0x01).WideText(U"", 4).U32(1).bytes());
  EXPECT_EQ(
      choice.Report(),
      "the bag, wstring of 4-byte characters; the bag, wstring of 2-byte characters fits as well");
}

TEST(MsgPath, ReadsPackageTreesAndLooseFiles) {
  const Folder folder(
      {{"my_msgs/msg/State.msg", "Inner inner\nstd_msgs/Header header\n"},
       {"my_msgs/msg/Inner.msg", "float32 a\n"},
       {"flat_msgs/Thing.msg", "int8 a\n"},
       {"idl_msgs/idl/Odd.idl", "module idl_msgs { module msg { struct Odd { short a; }; }; };"},
       {"Loose.msg", "Part part\n"},
       {"Part.msg", "int64 a\n"}});
  for (const char* type :
       {"my_msgs/msg/State", "flat_msgs/msg/Thing", "idl_msgs/msg/Odd", "any/msg/Loose"}) {
    const TypeChoice choice = Resolve(type, {folder.path()});
    ASSERT_NE(choice.taken(), nullptr) << choice.Report();
    EXPECT_EQ(choice.taken()->type.name(), type);
    EXPECT_EQ(choice.Report(), "--msg-path " + folder.path().string());
  }
  EXPECT_EQ(Resolve("other/msg/State", {folder.path()}).taken(), nullptr);
}

TEST(MsgPath, APackageFolderMayBeGivenItself) {
  const Folder folder(
      {{"my_msgs/msg/State.msg", "Inner inner\n"}, {"my_msgs/msg/Inner.msg", "float32 a\n"}});
  for (const fs::path& path : {folder.path() / "my_msgs", folder.path() / "my_msgs/msg"}) {
    EXPECT_NE(Resolve("my_msgs/msg/State", {path}).taken(), nullptr);
    EXPECT_EQ(Resolve("other/msg/State", {path}).taken(), nullptr);
  }
}

TEST(MsgPath, LooseFilesDoNotReplaceTypesOfOtherPackages) {
  // Header.msg of somebody's own is no std_msgs/Header.
  const Folder folder(
      {{"Mine.msg", "std_msgs/Header header\nHeader own\n"}, {"Header.msg", "int8 a\n"}});
  const TypeChoice choice = Resolve("my/msg/Mine", {folder.path()});
  ASSERT_NE(choice.taken(), nullptr) << choice.Report();
  const MessageType& type = choice.taken()->type;
  EXPECT_EQ(ResolveField(type, "header.frame_id").type, FieldType::kString);
  EXPECT_EQ(ResolveField(type, "own.a").type, FieldType::kInt8);
}

TEST(MsgPath, TwoLayoutsOfOneNameInAFolderAreBothTried) {
  const Folder folder(
      {{"dls/msg/Imu.msg", "float64 a\n"},
       {"dls/idl/Imu.idl", "module dls { module msg { struct Imu { double a; double b; }; }; };"}});
  TypeChoice choice = Resolve("dls/msg/Imu", {folder.path()});
  choice.Show(CdrWriter(0x01).F64(1).F64(2).bytes());
  ASSERT_NE(choice.taken(), nullptr) << choice.Report();
  EXPECT_EQ(ListLeaves(choice.taken()->type).size(), 2u);
}

TEST(MsgPath, UsersDefinitionsComeBeforeBuiltInOnes) {
  const Folder folder({{"interfaces/msg/BatteryState.msg", "float32 v\nfloat32 a\n"}});
  TypeChoice choice = Resolve("interfaces/msg/BatteryState", {folder.path()});
  choice.Show(CdrWriter(0x01).F32(28).F32(3).bytes());
  EXPECT_EQ(choice.Report(), "--msg-path " + folder.path().string() + "; built in fits as well");
}

TEST(MsgPath, ErrorsNameTheFileOrTheFolder) {
  const Folder folder({{"my/msg/Bad.msg", "float64\n"}, {"empty/readme.txt", ""}});
  EXPECT_EQ(Resolve("my/msg/Bad", {folder.path()}).Report(),
            fs::canonical(folder.path()).string() +
                "/my/msg/Bad.msg:1: \"float64\": a type is followed by the name of a field");
  const auto error = [](const fs::path& path) {
    return test::ErrorOf<DefinitionError>([&] { TypeResolver resolver({path}); });
  };
  EXPECT_EQ(error("/nowhere/msgs"), "--msg-path /nowhere/msgs: no such folder");
  EXPECT_EQ(error(folder.path() / "empty"),
            "--msg-path " + (folder.path() / "empty").string() + ": holds no .msg or .idl file");
}

}  // namespace
}  // namespace scoria::logs
