#include "mission/object_line.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace drover::mission {
namespace {

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

double number_of(std::string_view word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
    throw std::runtime_error("no number: '" + std::string(word) + "'");
  return value;
}

std::size_t sizes_of(std::string_view kind, std::size_t given) {
  if (kind == "box") return 3;
  if (kind == "cylinder" || kind == "cone") return 2;
  if (kind == "sphere") return 1;
  if (kind == "prism" && given >= 7 && given % 2 == 1) return given;
  throw std::runtime_error("no such solid: " + std::string(kind));
}

}  // namespace

ObjectLine parse_object_line(std::string_view line) {
  const auto end = line.find(") ");
  const auto dot = line.find('.');
  if (line.empty() || line[0] != '(' || end == std::string_view::npos || dot + 10 != end)
    throw std::runtime_error("no stamp in '" + std::string(line) + "'");
  ObjectLine parsed;
  std::int64_t s = 0;
  std::int64_t ns = 0;
  const auto a = std::from_chars(line.data() + 1, line.data() + dot, s);
  const auto b = std::from_chars(line.data() + dot + 1, line.data() + end, ns);
  if (a.ptr != line.data() + dot || b.ptr != line.data() + end)
    throw std::runtime_error("no stamp in '" + std::string(line) + "'");
  parsed.time = Time{std::chrono::seconds(s) + Duration(ns)};
  const auto words = words_of(line.substr(end + 2));
  if (words.size() < 2) throw std::runtime_error("too few words in '" + std::string(line) + "'");
  parsed.verb = words[0];
  parsed.name = words[1];
  const std::size_t numbers_from = parsed.verb == "put" ? 3 : 2;
  for (std::size_t i = numbers_from; i < words.size(); ++i)
    parsed.numbers.push_back(number_of(words[i]));
  const auto expect = [&](std::size_t count) {
    if (parsed.numbers.size() != count)
      throw std::runtime_error("another number of numbers in '" + std::string(line) + "'");
  };
  if (parsed.verb == "put") {
    if (words.size() < 7) throw std::runtime_error("too few words in '" + std::string(line) + "'");
    const std::size_t sizes = parsed.numbers.size() - 4;
    expect(4 + sizes_of(words[2], sizes));
    const auto& n = parsed.numbers;
    parsed.solid = {parsed.name, std::string(words[2]),   n[0], n[1], n[2],
                    n[3],        {n.begin() + 4, n.end()}};
  } else if (parsed.verb == "at") {
    expect(2);
  } else if (parsed.verb == "touch") {
    expect(7);
  } else if (parsed.verb == "leave") {
    expect(3);
  } else if (parsed.verb == "gone" || parsed.verb == "watching") {
    expect(0);
  } else {
    throw std::runtime_error("unknown word in '" + std::string(line) + "'");
  }
  return parsed;
}

}  // namespace drover::mission
