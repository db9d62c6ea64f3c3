#pragma once
/// A value that varies in time as a file of comma-separated values says.
#include <filesystem>
#include <string>
#include <vector>

namespace mudlark {

/// Which columns of a file are meant.
struct RecordColumns {
  int value = 2, time = 1;  ///< counted from 1
  std::string name;         ///< of the value's column in the header; used instead when not empty
};

/// The columns as written in the file, with the units that its header gives in square brackets
/// ("time [s]"); empty where it gives none.
struct TimeRecord {
  std::vector<double> times, values;
  std::vector<int> lines;  ///< of the file, counted from 1
  std::string time_unit, unit;
  int column = 0;  ///< of the values, counted from 1
};

/// Reads columns that are separated by commas, semicolons, tabs or blanks; lines that are empty or
/// begin with # are skipped, and the first other line may be a header. Throws InputError with the
/// name of the file and the line.
TimeRecord read_time_record(const std::filesystem::path& file, const RecordColumns& columns);

}  // namespace mudlark
