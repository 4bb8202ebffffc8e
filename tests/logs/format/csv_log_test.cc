// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/csv_log.h"

#include <fstream>

#include <gtest/gtest.h>

#include "logs/format/open_log.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

/// A folder of files made for one test.
class Files {
 public:
  fs::path Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  [[nodiscard]] const fs::path& path() const { return folder_.path(); }

 private:
  test::TemporaryFolder folder_;
};

std::string TextOf(const LogMessage& m) {
  return {reinterpret_cast<const char*>(m.data.data()), m.data.size()};
}

/// "channel time: line" of every message.
std::vector<std::string> LinesOf(LogSource& log, const LogFilter& filter = {}) {
  std::vector<std::string> lines;
  log.ForEach(filter, [&](const LogMessage& m) {
    lines.push_back(m.channel.topic + " " + std::to_string(m.log_time_ns) + ": " + TextOf(m));
  });
  return lines;
}

std::vector<std::string> LinesOf(const std::string& text) {
  const Files files;
  return LinesOf(*OpenLog(files.Write("a.csv", text)));
}

using Texts = std::vector<std::string>;

TEST(CsvLog, IsAChannelWhoseMessagesAreLines) {
  const Files files;
  const auto log = OpenLog(files.Write("walk.csv", "t,q\n0.5,1\n1.25,2\n"));
  const LogContents& contents = log->contents();
  EXPECT_EQ(contents.format, "a CSV file");
  ASSERT_EQ(contents.channels.size(), 1u);
  const LogChannel& channel = contents.channels[0];
  EXPECT_EQ(channel.topic, "walk");
  EXPECT_EQ(channel.message_encoding, "csv");
  EXPECT_EQ(channel.schema, (LogSchema{"csv", "t,q"}));
  EXPECT_EQ(contents.span, (LogSpan{500'000'000, 1'250'000'000}));
  EXPECT_EQ(CsvLayoutOf(channel).names, (Texts{"t", "q"}));
  EXPECT_EQ(LinesOf(*log), (Texts{"walk 500000000: 0.5,1", "walk 1250000000: 1.25,2"}));
  EXPECT_EQ(LinesOf(*log, {.from_ns = 600'000'000}), (Texts{"walk 1250000000: 1.25,2"}));
  EXPECT_EQ(LinesOf(*log, {.topics = Texts{"other"}}), Texts{});
  EXPECT_TRUE(log->problems().empty());
}

TEST(CsvLog, ReadsEverySeparator) {
  const Texts expected = {"a 1000000000: 1", "a 2000000000: 2"};
  for (const std::string separator : {",", ";", "\t", " ", "   ", " , "}) {
    Texts lines = LinesOf("1" + separator + "5.5" + separator + "-1e-3\n2" + separator + "6" +
                          separator + "7\n");
    for (std::string& line : lines) line.resize(expected[0].size());
    EXPECT_EQ(lines, expected) << "\"" << separator << "\"";
  }
}

TEST(CsvLog, KnowsTheEndsOfLinesMarksAndComments) {
  EXPECT_EQ(LinesOf("\xef\xbb\xbf# made by hand\r\n# t, q\r\n\r\n0.1, 5\r\n# a remark\r\n0.2, 6"),
            (Texts{"a 100000000: 0.1, 5", "a 200000000: 0.2, 6"}));
  const Files files;
  const auto log = OpenLog(files.Write("numpy.txt", "# made by hand\n# t q\n0.1 5\n0.2 6\n"));
  EXPECT_EQ(CsvLayoutOf(log->contents().channels[0]).names, (Texts{"t", "q"}));
}

TEST(CsvLog, QuotesKeepSeparatorsAndQuotes) {
  CsvSplitter splitter(',');
  const auto split = [&](std::string_view line) {
    const auto fields = splitter.Split(line);
    return Texts(fields.begin(), fields.end());
  };
  EXPECT_EQ(split(R"(1,"a,b",3)"), (Texts{"1", "a,b", "3"}));
  EXPECT_EQ(split(R"("say ""a""", "" ,x)"), (Texts{R"(say "a")", "", "x"}));
  EXPECT_EQ(split(R"("never closed, x)"), (Texts{"never closed, x"}));
  EXPECT_EQ(split("a,,b,"), (Texts{"a", "", "b", ""}));
}

TEST(CsvLog, NumbersMayHaveACommaAsPoint) {
  EXPECT_EQ(ParseCsvNumber("1,25"), 1.25);
  EXPECT_EQ(ParseCsvNumber("+1e3"), 1000.0);
  EXPECT_EQ(ParseCsvNumber("True"), 1.0);
  EXPECT_EQ(ParseCsvNumber("nan"), std::nullopt);
  EXPECT_EQ(ParseCsvNumber(""), std::nullopt);
  EXPECT_EQ(ParseCsvNumber("1.2.3"), std::nullopt);
  EXPECT_EQ(LinesOf("t;q\n0,5;1,25\n0,75;2\n"),
            (Texts{"a 500000000: 0,5;1,25", "a 750000000: 0,75;2"}));
}

TEST(CsvLog, TimesAreExactToTheirDigits) {
  EXPECT_EQ(ParseCsvTime("1713992942.653110123", 1'000'000'000), 1713992942653110123);
  EXPECT_EQ(ParseCsvTime("1764707760302269650", 1), 1764707760302269650);
  EXPECT_EQ(ParseCsvTime("-0.25", 1'000'000'000), -250'000'000);
  EXPECT_EQ(ParseCsvTime("1.5e3", 1'000'000), 1'500'000'000);
  EXPECT_EQ(ParseCsvTime("12.3456", 1'000'000), 12'345'600);
  EXPECT_EQ(ParseCsvTime("99999999999999999999", 1'000'000'000), std::nullopt);
  EXPECT_EQ(ParseCsvTime("soon", 1), std::nullopt);
}

/// What is taken for the time of a file: "column unit", or "lines".
std::string ClockOf(const std::string& text) {
  const auto dialect = DetectCsv(text, true);
  if (!dialect) return "no table";
  if (!dialect->clock) return "lines";
  return std::to_string(dialect->clock->column) + " " + std::to_string(dialect->clock->unit_ns);
}

TEST(CsvLog, TakesTheColumnThatGrowsAsTime) {
  EXPECT_EQ(ClockOf("q,t\n5,0\n4,0.5\n3,1\n"), "1 1000000000");
  EXPECT_EQ(ClockOf("%time,field.header.stamp\n1638567086107885441,1\n1638567086109885442,2\n"),
            "0 1");
  EXPECT_EQ(ClockOf("q,time_ms\n1,0\n2,2\n"), "1 1000000");
  EXPECT_EQ(ClockOf("stamp,q\n1713992942653,1\n1713992942655,2\n"), "0 1000000");
  EXPECT_EQ(ClockOf("1764707760302269650,1\n1764707760306999131,2\n"), "0 1");
  EXPECT_EQ(ClockOf("x,y\n1,2\n2,1\n"), "lines");             // grows, and is called x
  EXPECT_EQ(ClockOf("time,y\n1,2\n0.5,1\n"), "lines");        // falls
  EXPECT_EQ(ClockOf(",y\n0,2\n1,1\n2,1\n"), "lines");         // numbers of rows
  EXPECT_EQ(ClockOf("name: robot\nsize: 12\n"), "no table");  // YAML
  EXPECT_EQ(ClockOf("a,b\nc,d\n"), "no table");
  EXPECT_EQ(ClockOf("t,q\n"), "no table");
}

TEST(CsvLog, WithoutAClockTheTimeIsTheLineNumber) {
  EXPECT_EQ(LinesOf("x,y\n5,6\n4,7\n"), (Texts{"a 2: 5,6", "a 3: 4,7"}));
}

TEST(CsvLog, SaysWhatItLeavesOut) {
  const Files files;
  std::string text = "t,a,b\n";
  for (int i = 0; i < 60; ++i) text += std::to_string(0.1 * i) + ",1,2\n";
  const fs::path path = files.Write("a.csv", text + "7.0,1\nx,1,2\n7.1,1,2,3\n7.2,1,2\n7.3,1");
  const auto log = OpenLog(path);
  EXPECT_EQ(LinesOf(*log).size(), 61u);
  EXPECT_EQ(LinesOf(*log).back(), "a 7200000000: 7.2,1,2");
  ASSERT_EQ(log->problems().size(), 2u);  // each once, however often it is read
  EXPECT_EQ(log->problems()[0],
            (LogProblem{LogProblem::Kind::kCut, path, "the last line, 66, is cut"}));
  EXPECT_EQ(log->problems()[1],
            (LogProblem{LogProblem::Kind::kLost, path,
                        "3 lines are left out, the first is line 62, which has 2 fields in place "
                        "of 3"}));
}

TEST(CsvLog, SeveralFilesAreOneLogInTheOrderOfTime) {
  const Files files;
  const fs::path a = files.Write("a.csv", "0.1,1\n0.3,2\n"),
                 b = files.Write("b.csv", "t,x\n0.1,5\n0.2,6\n");
  const Texts expected = {"a 100000000: 0.1,1", "b 100000000: 0.1,5", "b 200000000: 0.2,6",
                          "a 300000000: 0.3,2"};
  EXPECT_EQ(LinesOf(*OpenLog(std::vector{a, b})), expected);
  EXPECT_EQ(LinesOf(*OpenLog(files.path())), expected);
  EXPECT_EQ(OpenLog(files.path())->contents().format, "2 CSV files");
}

std::string ErrorOf(const std::vector<fs::path>& paths) {
  try {
    (void)OpenLog(paths);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(CsvLog, SaysWhyFilesAreNotOneLog) {
  const Files files;
  const fs::path a = files.Write("a.csv", "0.1,1\n0.3,2\n"),
                 same = files.Write("a.txt", "0.1,1\n0.3,2\n"),
                 yaml = files.Write("b.csv", "name: x\n");
  EXPECT_EQ(ErrorOf({a, yaml}),
            yaml.string() + ": is no CSV file; only those can be one log together");
  EXPECT_EQ(ErrorOf({a, same}), same.string() + ": there are two files of the name a");
  EXPECT_EQ(ErrorOf({yaml}), yaml.string() + ": is not a log that scoria reads");
}

TEST(CsvLog, LinesBeyondABlockAreWhole) {
  const Files files;
  std::string text = "t,q\n";
  constexpr int kRows = 100'000;
  for (int i = 0; i < kRows; ++i)
    text += std::to_string(0.001 * i) + "," + std::to_string(i) + "\n";
  const auto log = OpenLog(files.Write("a.csv", text));
  int i = 0;
  log->ForEach({}, [&](const LogMessage& m) {
    const std::string line = TextOf(m);
    EXPECT_EQ(line.substr(line.find(',') + 1), std::to_string(i++));
  });
  EXPECT_EQ(i, kRows);
}

}  // namespace
}  // namespace scoria::logs
