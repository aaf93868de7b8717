#include "cli/show_learned.h"

#include "cli/layout.h"

namespace drover::cli {

namespace {

constexpr std::size_t kNameColumn = 29;
constexpr std::size_t kNumberColumn = 13;

std::string with_unit(const json::Node& number, const std::string& unit) {
  const std::string digits = quantity(number, "%.4g");
  return digits == "-" || unit.empty() ? digits : digits + " " + unit;
}

}  // namespace

std::string show_learned(const json::Node& answer) {
  const json::Node& learned = at(answer, "learned");
  const json::Node& values = at(learned, "values");
  std::string out = "nothing yet: straights there and back, turns and changes of speed teach it\n";
  if (count(values) > 0)
    out = padded("", kNameColumn) + padded("configured", kNumberColumn) +
          padded("fits", kNumberColumn) + "within\n";
  for (std::size_t i = 0; i < count(values); ++i) {
    const json::Node& value = entry(values, i);
    const std::string unit = text(at(value, "unit"));
    out += padded(text(at(value, "name")), kNameColumn);
    out += padded(with_unit(at(value, "configured"), unit), kNumberColumn);
    out += padded(with_unit(at(value, "fits"), unit), kNumberColumn);
    out += padded("+- " + with_unit(at(value, "interval"), unit), kNumberColumn);
    out += text(at(value, "used")) + "\n";
  }
  const std::string problem = text(at(learned, "problem"));
  const std::string since = date(at(learned, "kept_s"), "%Y-%m-%d %H:%M UTC");
  if (!problem.empty()) {
    out += "not on the disk: " + problem + "\n";
  } else if (!since.empty() && count(values) > 0) {
    out += "kept on the disk, of " + since + "\n";
  }
  return out;
}

}  // namespace drover::cli
