/// `mudlark strength-reduction` on a layer whose factor of safety is known.
#include "regression/run/runs.hpp"

namespace mudlark {
namespace {

using StrengthReduction = RunTest;

double number_after(const std::string& text, const std::string& key) {
  const std::size_t at = text.find("\"" + key + "\": ");
  return at == std::string::npos ? NAN : std::stod(text.substr(at + key.size() + 4));
}

TEST_F(StrengthReduction, FindsTheFactorOfALayerOnAnInclinedPlane) {
  const Result found = program({"strength-reduction", case_file("slide").string(), "--lower", "1.1",
                                "--upper", "2", "--tolerance", "0.03", "-o", "out"});
  ASSERT_EQ(found.code, 0) << found.output;
  EXPECT_NE(found.output.find("factor of safety"), std::string::npos) << found.output;
  const std::string json = text_of(results("out") / "strength_reduction.json");
  // s_u / (rho g H sin 20 degrees); the lowest points lie H/40 above the plane
  EXPECT_NEAR(number_after(json, "factor of safety"), 8000.0 / (1590.0 * 3.35522), 0.05 * 1.5)
      << found.output;
  EXPECT_LE(number_after(json, "fails at") - number_after(json, "stands at"), 0.0301);
  EXPECT_EQ(status_of(results("out") / "trials/1.1"), "\"done\"");
}

/// With one water rest is that of soil and water together. In air, with the weight that it has
/// under water, the same bank stands at 1.4375 and fails at 1.5.
TEST_F(StrengthReduction, JudgesABankUnderWaterByItsWeightThere) {
  const Result found =
      wait_patiently(start({"strength-reduction", case_file("slope_under_water").string(),
                            "--lower", "1.25", "--upper", "2", "--tolerance", "0.8", "-o", "out"}));
  ASSERT_EQ(found.code, 0) << found.output;
  const std::string json = text_of(results("out") / "strength_reduction.json");
  EXPECT_EQ(number_after(json, "stands at"), 1.25) << found.output;
  EXPECT_EQ(number_after(json, "fails at"), 2.0) << found.output;
}

/// At F = 1.6 the layer slides; what has not yet slid far when the run ends may as well be on its
/// way to rest.
TEST_F(StrengthReduction, WarnsOfATrialThatOnlyRanOutOfTime) {
  const auto search = [&](const std::string& end) {
    return program({"strength-reduction", case_file("slide").string(), "--lower", "1.1", "--upper",
                    "1.6", "--tolerance", "0.6", "-o", "out", "--set", "time.end=" + end});
  };
  const Result late = search("4"), early = search("0.5");
  ASSERT_EQ(late.code, 0) << late.output;
  EXPECT_EQ(late.output.find("warning"), std::string::npos) << late.output;
  ASSERT_EQ(early.code, 0) << early.output;
  EXPECT_NE(early.output.find("warning: at F = 1.6 "), std::string::npos) << early.output;
  EXPECT_NE(early.output.find("A later end tells"), std::string::npos) << early.output;
  EXPECT_NE(text_of(results("out") / "strength_reduction.json").find("\"undecided\": true"),
            std::string::npos);
}

TEST_F(StrengthReduction, SaysWhenTheFactorLiesElsewhere) {
  const std::string file = case_file("slide").string();
  const Result above =
      program({"strength-reduction", file, "--lower", "1", "--upper", "1.2", "-o", "out"});
  EXPECT_EQ(above.code, 1);
  EXPECT_NE(above.output.find("larger --upper"), std::string::npos) << above.output;
  const Result below =
      program({"strength-reduction", file, "--lower", "2", "--upper", "3", "-o", "out"});
  EXPECT_EQ(below.code, 1);
  EXPECT_NE(below.output.find("smaller --lower"), std::string::npos) << below.output;
  EXPECT_NE(text_of(results("out") / "strength_reduction.json").find("\"factor of safety\": null"),
            std::string::npos);
}

TEST_F(StrengthReduction, RefusesWhatItCannotJudge) {
  const Result no_rest = program({"strength-reduction", case_file("soil_3d").string()});
  EXPECT_EQ(no_rest.code, 1);
  EXPECT_NE(no_rest.output.find("stop_when_static"), std::string::npos) << no_rest.output;
  const Result elastic =
      program({"strength-reduction", case_file("rest").string(), "-o", "elastic"});
  EXPECT_EQ(elastic.code, 1);
  EXPECT_NE(elastic.output.find("mohr-coulomb"), std::string::npos) << elastic.output;
  const Result order = program({"strength-reduction", case_file("slide").string(), "--lower", "3"});
  EXPECT_EQ(order.code, 1);
  EXPECT_NE(order.output.find("lower < upper"), std::string::npos) << order.output;
}

}  // namespace
}  // namespace mudlark
