/// The command line: which command with which arguments, and one exit code.
#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "parallel_session.hpp"

namespace mudlark {
namespace {

/// The words of the command without -n, for the ranks that -n starts.
std::vector<std::string> without_ranks(int argc, char** argv) {
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "-n" || word == "--ranks")
      ++i;
    else if (!(word.starts_with("-n") && word.size() > 2 && word[2] != '-') &&
             !word.starts_with("--ranks="))
      words.push_back(word);
  }
  return words;
}

void add_run(CLI::App& app, RunArguments& run) {
  CLI::App* command = app.add_subcommand("run", "Run a case");
  command->add_option("case", run.case_file, "Case file (TOML)")
      ->required()
      ->type_name("CASE.toml");
  command->add_option("-n,--ranks", run.ranks, "Number of ranks (MPI processes) to start")
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("RANKS");
  command
      ->add_option("-o,--output", run.results, "Results folder [results/<name of the case file>]")
      ->type_name("DIR");
  command->add_flag("--resume", run.resume, "Go on from the last checkpoint in the results folder");
  command->add_option("--until", run.until, "Stop at this simulated time, for example \"2 h\"")
      ->type_name("TIME");
  command->add_flag("--quiet", run.quiet, "No progress lines");
  command
      ->add_option("--set", run.overrides, "Override a key of the case file: soil.0.porosity=0.35")
      ->type_name("KEY=VALUE");
}

void add_strength_reduction(CLI::App& app, StrengthReductionArguments& search) {
  CLI::App* command = app.add_subcommand(
      "strength-reduction", "Factor of safety: the strength is reduced until the soil fails");
  command->add_option("case", search.case_file, "Case file (TOML)")
      ->required()
      ->type_name("CASE.toml");
  command->add_option("--lower", search.lower, "Factor at which the soil stands [1]");
  command->add_option("--upper", search.upper, "Factor at which it fails [3]");
  command->add_option("--tolerance", search.tolerance, "Width of the bracket at the end [0.02]");
  command->add_option("--largest-displacement", search.largest_displacement,
                      "Soil that moved further has failed, in m [a tenth of a cell]");
  command->add_option("-n,--ranks", search.ranks, "Number of ranks (MPI processes) to start")
      ->check(CLI::Range(1, 1 << 20))
      ->type_name("RANKS");
  command
      ->add_option("-o,--output", search.results,
                   "Results folder [results/<name of the case file>]")
      ->type_name("DIR");
  command
      ->add_option("--set", search.overrides,
                   "Override a key of the case file: soil.0.porosity=0.35")
      ->type_name("KEY=VALUE");
}

void add_check(CLI::App& app, CheckArguments& check) {
  CLI::App* command = app.add_subcommand(
      "check", "Validate a case; print every resolved value, stable steps, memory and cost");
  command->add_option("case", check.case_file, "Case file (TOML)")
      ->required()
      ->type_name("CASE.toml");
  command->add_option("--picture", check.picture, "Draw the initial state into this file")
      ->type_name("FILE.png");
  command
      ->add_option("--set", check.overrides,
                   "Override a key of the case file: soil.0.porosity=0.35")
      ->type_name("KEY=VALUE");
}

ExitCode command_line(int argc, char** argv) {
  CLI::App app("Mudlark: water and soil that move together (free-surface flow and material points)",
               "mudlark");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text);
  RunArguments run;
  StrengthReductionArguments search;
  CheckArguments check;
  std::string name, results;
  add_run(app, run);
  add_strength_reduction(app, search);
  add_check(app, check);
  CLI::App* cases = app.add_subcommand("cases", "List the shipped cases, or copy one here to edit");
  cases->add_option("name", name, "Case to copy")->type_name("NAME");
  CLI::App* info = app.add_subcommand("info", "What a results folder holds");
  info->add_option("folder", results, "Results folder")->required()->type_name("DIR");
  CLI::App* plot = app.add_subcommand("plot", "Pictures of a results folder, drawn by python3");
  plot->add_option("folder", results, "Results folder")->required()->type_name("DIR");
  plot->prefix_command();
  plot->footer(
      "After the folder:\n"
      "  --field NAME                one grid field or quantity of the material points\n"
      "  --time SECONDS              the output nearest to this time only\n"
      "  --gauge NAME [NAME ...]     these gauges only\n"
      "  --out FILE.png              into this file; else into the folder's plots");
  CLI::App* report =
      app.add_subcommand("report", "One HTML page of a results folder, made by python3");
  report->add_option("folder", results, "Results folder")->required()->type_name("DIR");
  report->prefix_command();
  report->footer(
      "After the folder:\n"
      "  --frames NUMBER             at most so many outputs under the slider\n"
      "  --out FILE.html             into this file; else report.html in the folder");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? ExitCode::done : ExitCode::wrong_input;
  }
  if (app.got_subcommand("run")) return run_command(run, without_ranks(argc, argv));
  if (app.got_subcommand("strength-reduction"))
    return strength_reduction_command(search, without_ranks(argc, argv));
  if (app.got_subcommand("check")) return check_command(check);
  if (app.got_subcommand(cases)) return cases_command(name);
  if (app.got_subcommand(info)) return info_command(results);
  if (app.got_subcommand(report)) return python_command("report", results, report->remaining());
  return python_command("plot", results, plot->remaining());
}

}  // namespace
}  // namespace mudlark

int main(int argc, char** argv) {
  return static_cast<int>(mudlark::guarded([&] { return mudlark::command_line(argc, argv); }));
}
