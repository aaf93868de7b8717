#include "cli/svg_page.h"

#include <algorithm>

#include "text/number.h"
#include "text/utf8.h"

namespace drover::cli {
namespace {

constexpr std::size_t kLineColumns = 58;

/// Lines of at most so many characters, broken between words where there are any.
std::vector<std::string> wrapped(std::string_view text, std::size_t columns) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    std::size_t bytes = 0;
    std::size_t space = 0;
    for (std::size_t n = 0; n < columns && bytes < text.size(); ++n) {
      if (text[bytes] == ' ') space = bytes;
      bytes += std::max<std::size_t>(text::character_bytes(text.substr(bytes)), 1);
    }
    if (bytes < text.size() && space > 0) bytes = space;
    lines.emplace_back(text.substr(0, bytes));
    text.remove_prefix(bytes);
    while (text.starts_with(' ')) text.remove_prefix(1);
  }
  return lines;
}

}  // namespace

std::string xml_text(std::string_view text) {
  constexpr std::string_view kReplacement = "\xEF\xBF\xBD";
  std::string out;
  while (!text.empty()) {
    const std::size_t bytes = text::character_bytes(text);
    const auto character = text.substr(0, std::max<std::size_t>(bytes, 1));
    const auto first = static_cast<unsigned char>(character.front());
    // U+FFFE and U+FFFF are no characters of XML either.
    const bool allowed = bytes > 0 && (first >= 0x20 || character == "\t") &&
                         character != "\xEF\xBF\xBE" && character != "\xEF\xBF\xBF";
    out += !allowed            ? kReplacement
           : character == "&"  ? std::string_view("&amp;")
           : character == "<"  ? std::string_view("&lt;")
           : character == ">"  ? std::string_view("&gt;")
           : character == "\"" ? std::string_view("&quot;")
           : character == "'"  ? std::string_view("&#39;")
                               : character;
    text.remove_prefix(character.size());
  }
  return out;
}

std::string px(double value) {
  return text::formed("%.1f", value);
}

std::string text_at(double x, double y, std::string_view style, std::string_view text) {
  std::string out = "<text x=\"" + px(x) + "\" y=\"" + px(y) + "\" ";
  out += style;
  return out + ">" + xml_text(text) + "</text>\n";
}

std::string polyline(const std::vector<PagePoint>& points, std::string_view style) {
  std::string out = "<polyline points=\"";
  for (const PagePoint& point : points) out += px(point.x) + "," + px(point.y) + " ";
  out += "\" fill=\"none\" ";
  out += style;
  return out + "/>\n";
}

void Page::write(std::string_view text, std::string_view style) {
  for (const auto& each : wrapped(text, kLineColumns)) {
    body_ += text_at(kPageMargin, y_, style, each);
    y_ += kPageLine;
  }
}

std::string Page::svg(std::string_view title) const {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
         text::formed("%.0f ", kPageWidth) + text::formed("%.0f", y_) +
         "\" width=\"100%\" font-family=\"sans-serif\" font-size=\"21\">\n<title>" +
         xml_text(title) + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
         body_ + "</svg>\n";
}

}  // namespace drover::cli
