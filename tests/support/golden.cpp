// The reader of golden files.
#include "support/golden.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "support/describe.h"

namespace drover::test {
namespace {

std::string trimmed(std::string text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::uint8_t hex_byte(const std::string& digits) {
  std::size_t used = 0;
  const int value = std::stoi(digits, &used, 16);
  if (used != 2) throw std::invalid_argument("not two hex digits: " + digits);
  return static_cast<std::uint8_t>(value);
}

std::vector<std::uint8_t> parse_quoted(const std::string& text) {
  std::vector<std::uint8_t> bytes;
  if (text.size() < 2 || text.back() != '"') throw std::invalid_argument("no closing quote");
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    char c = text[i];
    if (c == '\\') {
      c = text.at(++i);
      if (c == 'r') {
        c = '\r';
      } else if (c == 'n') {
        c = '\n';
      } else if (c == 'x') {
        bytes.push_back(hex_byte(text.substr(i + 1, 2)));
        i += 2;
        continue;
      } else if (c != '\\' && c != '"') {
        throw std::invalid_argument("unknown escape");
      }
    }
    bytes.push_back(static_cast<std::uint8_t>(c));
  }
  return bytes;
}

std::vector<std::uint8_t> parse_bytes(const std::string& text) {
  if (!text.empty() && text[0] == '"') return parse_quoted(text);
  std::string digits = text;
  digits.erase(std::remove(digits.begin(), digits.end(), ' '), digits.end());
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2) bytes.push_back(hex_byte(digits.substr(i, 2)));
  return bytes;
}

void set_option(Options& options, const DriverEntry& entry, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos) throw std::invalid_argument("option without =");
  const std::string name = trimmed(text.substr(0, equals));
  const std::string value = trimmed(text.substr(equals + 1));
  const auto spec = std::find_if(entry.options.begin(), entry.options.end(),
                                 [&](const OptionSpec& each) { return each.name == name; });
  if (spec == entry.options.end()) throw std::invalid_argument("no such option: " + name);
  if (std::holds_alternative<bool>(spec->default_value)) {
    options.set(name, value == "true");
  } else if (std::holds_alternative<double>(spec->default_value)) {
    options.set(name, std::stod(value));
  } else {
    options.set(name, value);
  }
}

void read_line(const std::string& text, int number, const DriverEntry& entry, GoldenFile& file) {
  if (text.empty()) return;
  if (text[0] == '#') {
    file.has_source |= text.find("source:") != std::string::npos;
    file.has_provenance |= text.find("provenance:") != std::string::npos;
    return;
  }
  if (text.rfind("option ", 0) == 0) return set_option(file.options, entry, text.substr(7));
  if (text.rfind("map ", 0) == 0) {
    file.map = trimmed(text.substr(4));
    return;
  }
  const auto arrow = text.rfind(" => ");
  if (arrow == std::string::npos) throw std::invalid_argument("no =>");
  GoldenCase one;
  one.line = number;
  one.expected = trimmed(text.substr(arrow + 4));
  const std::string input = trimmed(text.substr(0, arrow));
  if (input.rfind("frame ", 0) == 0) {
    one.is_frame = true;
    one.frame = parse_frame(trimmed(input.substr(6)));
  } else if (input.rfind("bytes ", 0) == 0) {
    one.bytes = parse_bytes(trimmed(input.substr(6)));
  } else if (input.rfind("exchange ", 0) == 0) {
    one.is_exchange = true;
    one.bytes = parse_bytes(trimmed(input.substr(9)));
  } else {
    throw std::invalid_argument("neither option, map, frame, bytes nor exchange");
  }
  file.cases.push_back(one);
}

}  // namespace

GoldenFile read_golden(const std::filesystem::path& path, const DriverEntry& entry) {
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error("cannot read " + path.string());
  GoldenFile file;
  file.path = path;
  file.options = Options(entry.options);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    try {
      read_line(trimmed(line), number, entry, file);
    } catch (const std::exception& error) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return file;
}

std::vector<GoldenFile> read_goldens(const std::filesystem::path& source_dir,
                                     const DriverEntry& entry) {
  std::vector<std::filesystem::path> paths;
  const auto folder = source_dir / "drivers" / std::string(entry.folder) / "golden";
  if (std::filesystem::is_directory(folder))
    for (const auto& each : std::filesystem::directory_iterator(folder))
      if (each.path().extension() == ".txt") paths.push_back(each.path());
  std::sort(paths.begin(), paths.end());
  std::vector<GoldenFile> files;
  for (const auto& path : paths) files.push_back(read_golden(path, entry));
  return files;
}

}  // namespace drover::test
