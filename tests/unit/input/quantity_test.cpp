#include "input/quantity.hpp"

#include <gtest/gtest.h>

#include "base/errors.hpp"

namespace mudlark {
namespace {

double si(const std::string& text, const Quantity& quantity) {
  return read_quantity("value", text, quantity);
}

std::string problem(const std::string& text, const Quantity& quantity) {
  const auto reading = Units().read(text, quantity);
  return reading ? reading->problem : "not a quantity";
}

TEST(Units, ConvertToSi) {
  EXPECT_DOUBLE_EQ(si("1e-4 cm/s", quantity::velocity), 1e-6);
  EXPECT_DOUBLE_EQ(si("400 kPa", quantity::pressure), 4e5);
  EXPECT_DOUBLE_EQ(si("2 h", quantity::time), 7200.0);
  EXPECT_DOUBLE_EQ(si("60 s", quantity::time), 60.0);
  EXPECT_DOUBLE_EQ(si("10 min", quantity::time), 600.0);
  EXPECT_DOUBLE_EQ(si("1.002e-3 Pa s", quantity::viscosity), 1.002e-3);
  EXPECT_DOUBLE_EQ(si("1.0214e-9 m2", quantity::permeability), 1.0214e-9);
  EXPECT_DOUBLE_EQ(si("2.65 g/cm3", quantity::density), 2650.0);
  EXPECT_DOUBLE_EQ(si(" -5cm ", quantity::length), -0.05);
  EXPECT_DOUBLE_EQ(si("40 %", quantity::number), 0.4);
}

TEST(Units, TakeABareNumberAsSi) { EXPECT_DOUBLE_EQ(si("2.5", quantity::length), 2.5); }

TEST(Units, RefuseAWrongDimensionAndSayWhichIsExpected) {
  EXPECT_NE(problem("400 kPa", quantity::time).find("a time [s] is expected"), std::string::npos);
  EXPECT_NE(problem("3 kg", quantity::density).find("wrong dimension"), std::string::npos);
}

TEST(Units, DoNotTakeAFrequencyForATimeAlthoughUdunitsConvertsReciprocals) {
  EXPECT_NE(problem("5 Hz", quantity::time).find("wrong dimension"), std::string::npos);
  EXPECT_NE(problem("5 m", quantity::time).find("minutes are \"min\""), std::string::npos);
  EXPECT_EQ(problem("5 kg", quantity::time).find("minutes"), std::string::npos);
}

TEST(Units, RefuseUnknownUnitsAndNumbersThatAreNone) {
  EXPECT_NE(problem("5 furlongz", quantity::length).find("no unit"), std::string::npos);
  EXPECT_NE(problem("nan", quantity::length).find("finite"), std::string::npos);
  EXPECT_NE(problem("inf m", quantity::length), "");
  EXPECT_NE(problem("1e999 m", quantity::length), "");
}

TEST(Units, LeaveExpressionsAlone) {
  EXPECT_FALSE(Units().read("1000*9.81*(2-z)", quantity::pressure).has_value());
  EXPECT_FALSE(Units().read("2 - z", quantity::pressure).has_value());
  EXPECT_FALSE(Units().read("sin(t)", quantity::pressure).has_value());
}

TEST(Units, CommandLineErrorNamesTheOption) {
  try {
    read_quantity("--until", "5 kg", quantity::time);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).rfind("--until = 5 kg", 0), 0u);
  }
}

}  // namespace
}  // namespace mudlark
