#include "cairn/core/errors.hpp"
#include "cairn/io/configuration.hpp"

#include <charconv>

namespace cairn {
namespace {

// Shortest text that reads back as the same double.
std::string number_text(double value) {
  char text[32];
  const auto result = std::to_chars(text, text + sizeof text, value);
  return {text, result.ptr};
}

// Words that YAML takes for something else than text.
bool is_reserved(const std::string& word) { return word == "null" || word == "Null" || word == "NULL"; }

// One character of a double-quoted scalar. Bytes beyond ASCII stay as they are.
std::string escaped(char c) {
  static constexpr char kDigits[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  if (c == '"' || c == '\\') return {'\\', c};
  if (byte < 0x20 || byte == 0x7f) return {'\\', 'x', kDigits[byte / 16], kDigits[byte % 16]};
  return {c};
}

// Double-quoted where a plain scalar could be taken for something else.
std::string scalar_text(const std::string& value) {
  const bool plain =
      !value.empty() && !is_reserved(value) &&
      value.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos;
  if (plain) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += escaped(c);
  return quoted + "\"";
}

class YamlOptionWriter final : public OptionVisitor {
 public:
  void number(const Field& field, double& value, Range) override { line(field, number_text(value)); }
  void integer(const Field& field, int& value, Range) override { line(field, std::to_string(value)); }
  void flag(const Field& field, bool& value) override { line(field, value ? "true" : "false"); }
  void choice(const Field& field, std::string& value, const std::vector<std::string>&) override {
    line(field, scalar_text(value));
  }
  void text(const Field& field, std::string& value) override { line(field, scalar_text(value)); }

  void section(const Field& field, const std::function<void(OptionVisitor&)>& visit) override {
    heading(field, "");
    indent_ += 2;
    visit(*this);
    indent_ -= 2;
  }

  void table(const Field& field, const std::vector<std::string>& present,
             const std::function<void(const std::string&, OptionVisitor&)>& visit_entry) override {
    heading(field, present.empty() ? " {}" : "");
    indent_ += 2;
    for (const std::string& key : present) {
      text_ += std::string(indent_, ' ') + scalar_text(key) + ":\n";
      indent_ += 2;
      visit_entry(key, *this);
      indent_ -= 2;
    }
    indent_ -= 2;
  }

  const std::string& result() const { return text_; }

 private:
  static constexpr std::size_t kCommentColumn = 34;

  void line(const Field& field, const std::string& value) {
    std::string entry = std::string(indent_, ' ') + field.name + ": " + value;
    if (entry.size() < kCommentColumn) entry.resize(kCommentColumn, ' ');
    text_ += entry + "  # " + field.documentation + "\n";
  }

  void heading(const Field& field, const std::string& value) {
    if (indent_ == 0) text_ += "\n";
    text_ += std::string(indent_, ' ') + field.name + ":" + value + "  # " + field.documentation + "\n";
  }

  std::string text_;
  std::size_t indent_ = 0;
};

}  // namespace

std::string write_configuration(const VisitOptions& visit) {
  YamlOptionWriter writer;
  visit(writer);
  return writer.result();
}

}  // namespace cairn
