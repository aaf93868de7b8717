// A page of SVG as high as what is on it: lines of text, and whatever is drawn between them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drover::cli {

// A phone's upright screen; letters as large as it needs them.
inline constexpr double kPageWidth = 720;
inline constexpr double kPageMargin = 36;
inline constexpr double kPageLine = 30;  ///< from one line of text to the next

struct PagePoint {
  double x = 0;
  double y = 0;
};

/// As text, or an attribute's value, of XML: what XML does not allow becomes U+FFFD.
std::string xml_text(std::string_view text);
/// A length or a coordinate.
std::string px(double value);
/// `text` is escaped; `style` are attributes, and stand as they are.
std::string text_at(double x, double y, std::string_view style, std::string_view text);
std::string polyline(const std::vector<PagePoint>& points, std::string_view style);

/// What was drawn so far, from the top.
class Page final {
 public:
  /// Broken between words into as many lines as it needs.
  void write(std::string_view text, std::string_view style = {});
  void add(std::string_view drawn) { body_ += drawn; }
  double y() const { return y_; }
  void go_to(double y) { y_ = y; }
  std::string svg(std::string_view title) const;

 private:
  std::string body_;
  double y_ = kPageMargin + 10;
};

}  // namespace drover::cli
