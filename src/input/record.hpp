#pragma once
/// The resolved input: every key that was read, with the value that holds, written back as TOML.
#include <list>
#include <string>
#include <string_view>
#include <vector>

namespace mudlark {

class Record {
 public:
  enum class Form { block, block_list_item, inline_table, inline_list };

  explicit Record(Form form = Form::block, std::string key = {})
      : form_(form), key_(std::move(key)) {}

  /// `text` is TOML; `unit` goes into a comment.
  void value(std::string_view key, std::string text, std::string_view unit = {});
  /// A comment line, for what is not set.
  void remark(std::string text);
  /// A table or list below this one. The reference lives as long as this record.
  Record& child(std::string_view key, Form form, std::string_view unit = {});

  /// As a block of TOML; `path` is the name of this table ("" for the root).
  std::string block(const std::string& path = {}) const;

 private:
  std::string inlined() const;
  bool is_block() const { return form_ == Form::block || form_ == Form::block_list_item; }

  Form form_;
  std::string key_, text_, unit_;
  std::list<Record> children_;
};

/// Shortest decimal that reads back as the same number.
std::string toml_number(double value);
std::string toml_numbers(const std::vector<double>& values);

}  // namespace mudlark
