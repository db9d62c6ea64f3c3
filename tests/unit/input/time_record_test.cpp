#include "input/time_record.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "base/errors.hpp"
#include "input/case_file.hpp"

namespace mudlark {
namespace {

namespace fs = std::filesystem;

class TimeRecordFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("mudlark-record-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& text, const std::string& name = "record.csv") {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  TimeRecord read(const std::string& text, const RecordColumns& columns = {}) {
    return read_time_record(write(text), columns);
  }
  std::string mistake(const std::string& text, const RecordColumns& columns = {}) {
    try {
      read(text, columns);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  /// The load of a case that says `pressure = ...`, or the mistakes.
  std::variant<Varying, std::string> load(const std::string& pressure) {
    write(
        "[domain]\nupper = [1, 1]\ncells = [4, 4]\n[time]\nend = 1\n[[soil]]\nname = \"s\"\n"
        "shape = { box = { lower = [0, 0], upper = [1, 0.5] } }\nporosity = 0.4\n"
        "pore_water = \"none\"\n"
        "law = { type = \"linear-elastic\", young_modulus = 1e6, poisson_ratio = 0.3 }\n"
        "[[load]]\nname = \"q\"\npressure = " +
            pressure + "\n",
        "case.toml");
    try {
      const CaseOptions options = read_case(folder_ / "case.toml", {});
      resolved_ = options.resolved_toml;
      return options.soil->loads[0].pressure;
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  }

  fs::path folder_;
  std::string resolved_;
};

TEST_F(TimeRecordFile, IsReadWhateverSeparatesItsColumns) {
  for (const std::string text :
       {"0,1\n0.5,2\n1,-3e-1\n",
        "\xef\xbb\xbf# made by hand\r\n\r\ntime;load\r\n0; 1\r\n0.5;2\r\n1;-0.3\r\n",
        "t a\n 0   1\n 0.5 2\n 1  -.3", "0\t1\n0.5\t+2\n1\t-0.3\n\n"}) {
    const TimeRecord record = read(text);
    EXPECT_EQ(record.times, (std::vector{0.0, 0.5, 1.0})) << text;
    EXPECT_EQ(record.values, (std::vector{1.0, 2.0, -0.3})) << text;
  }
}

TEST_F(TimeRecordFile, FindsColumnsByNumberAndByName) {
  const std::string text = "\"north [cm/s2]\",\"time [ms]\",up\n1,10,3\n4,20,6\n";
  const TimeRecord first = read(text, {3, 2, ""}), second = read(text, {2, 2, "north"});
  EXPECT_EQ(first.values, (std::vector{3.0, 6.0}));
  EXPECT_EQ(first.times, (std::vector{10.0, 20.0}));
  EXPECT_EQ(first.unit, "");
  EXPECT_EQ(second.values, (std::vector{1.0, 4.0}));
  EXPECT_EQ(second.unit, "cm/s2");
  EXPECT_EQ(second.time_unit, "ms");
  EXPECT_EQ(second.column, 1);
  EXPECT_EQ(second.lines, (std::vector{2, 3}));
}

TEST_F(TimeRecordFile, SaysWhichLineIsWrong) {
  const auto expect = [&](const std::string& text, const std::string& fragment,
                          const RecordColumns& columns = {}) {
    const std::string found = mistake(text, columns);
    EXPECT_NE(found.find(fragment), std::string::npos) << found;
  };
  expect("t,a\n0,1\n1,x\n", "record.csv:3: \"x\" in column 2 is not a number");
  expect("0,1\n1\n", "record.csv:2: column 2 is asked for, and the line has 1");
  expect("0,1\n1,2\n1,3\n", "record.csv:3: the time 1 does not lie after the one before, 1");
  expect("0;1,5\n", "record.csv:1: \"1,5\" in column 2 is not a number; write a decimal point");
  expect("0,1\n1,nan\n", "record.csv:2: \"nan\"");
  expect("", "record.csv: it holds no line of numbers");
  expect("time,load\n", "record.csv: it holds no line of numbers");
  expect("time,load\n0,1\n", "record.csv:1: there is no column \"up\"", {2, 1, "up"});
}

TEST_F(TimeRecordFile, GivesAVaryingValueInSiUnitsAndReadsBackTheSame) {
  write("time [min],load [kPa]\n0,0\n1,10\n");
  const auto varying = load("{ csv = \"record.csv\", column = \"load\", factor = -2 }");
  ASSERT_TRUE(std::holds_alternative<Varying>(varying)) << std::get<std::string>(varying);
  EXPECT_DOUBLE_EQ(std::get<Varying>(varying)({}, 30.0), -10000.0);
  EXPECT_FALSE(std::get<Varying>(varying).constant());
  const std::string resolved = resolved_;
  write(resolved, "resolved.toml");
  const CaseOptions again = read_case(folder_ / "resolved.toml", {});
  EXPECT_EQ(again.resolved_toml, resolved);
  EXPECT_DOUBLE_EQ(again.soil->loads[0].pressure({}, 30.0), -10000.0);
  const auto given = load("{ csv = \"record.csv\", unit = \"Pa\", time_unit = \"s\" }");
  ASSERT_TRUE(std::holds_alternative<Varying>(given));
  EXPECT_DOUBLE_EQ(std::get<Varying>(given)({}, 0.5), 5.0);
}

TEST_F(TimeRecordFile, MistakesNameTheCaseFileAndTheRecord) {
  const auto expect = [&](const std::string& pressure, const std::string& fragment) {
    const auto found = load(pressure);
    ASSERT_TRUE(std::holds_alternative<std::string>(found)) << pressure;
    const std::string& text = std::get<std::string>(found);
    EXPECT_NE(text.find("case.toml:14: "), std::string::npos) << text;
    EXPECT_NE(text.find(fragment), std::string::npos) << text;
  };
  write("0,1\n1,x\n");
  expect("{ csv = \"record.csv\" }", "record.csv:2: \"x\"");
  expect("{ csv = \"nowhere.csv\" }", "there is no such file");
  expect("{ csv = \"record.csv\", colum = 2 }", "Did you mean column?");
  write("t [s],v [m/s]\n0,1\n");
  expect("{ csv = \"record.csv\" }", "its unit is \"m/s\": \"m/s\" has the wrong dimension");
  expect("{ csv = \"record.csv\", unit = \"furz\" }", "no unit that UDUNITS-2 knows");
  expect("{ csv = \"record.csv\", column = 0 }", "counted from 1");
}

}  // namespace
}  // namespace mudlark
