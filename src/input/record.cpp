#include "input/record.hpp"

#include <fmt/format.h>

namespace mudlark {

void Record::value(std::string_view key, std::string text, std::string_view unit) {
  Record& leaf = children_.emplace_back(Form::inline_table, std::string(key));
  leaf.text_ = std::move(text);
  leaf.unit_ = unit == "1" ? "-" : unit;
}

void Record::remark(std::string text) { value("", "# " + std::move(text)); }

Record& Record::child(std::string_view key, Form form, std::string_view unit) {
  Record& record = children_.emplace_back(form, std::string(key));
  record.unit_ = unit;
  return record;
}

std::string Record::inlined() const {
  if (!text_.empty()) return text_;
  const bool list = form_ == Form::inline_list;
  std::string inside;
  for (const Record& child : children_) {
    if (!inside.empty()) inside += ", ";
    if (!child.key_.empty()) inside += child.key_ + " = ";
    inside += child.inlined();
  }
  return list ? "[" + inside + "]" : "{ " + inside + " }";
}

std::string Record::block(const std::string& path) const {
  std::string out, below;
  if (!path.empty()) out = form_ == Form::block ? "\n[" + path + "]\n" : "\n[[" + path + "]]\n";
  for (const Record& child : children_) {
    if (child.is_block()) {
      below += child.block(path.empty() ? child.key_ : path + "." + child.key_);
      continue;
    }
    out += child.key_.empty() ? child.text_ : child.key_ + " = " + child.inlined();
    out += child.unit_.empty() ? "\n" : fmt::format("  # [{}]\n", child.unit_);
  }
  return out + below;
}

std::string toml_number(double value) { return value == 0.0 ? "0" : fmt::format("{}", value); }

std::string toml_numbers(const std::vector<double>& values) {
  std::string out;
  for (const double value : values) out += (out.empty() ? "" : ", ") + toml_number(value);
  return "[" + out + "]";
}

}  // namespace mudlark
