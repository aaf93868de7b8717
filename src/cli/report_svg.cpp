#include "cli/report_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "cli/layout.h"
#include "cli/show_report.h"
#include "text/utf8.h"

namespace drover::cli {
namespace {

using json::Node;

// A phone's upright screen; letters as large as it needs them.
constexpr double kWidth = 720;
constexpr double kMargin = 36;
constexpr double kTallest = 900;
constexpr double kLowest = 160;
constexpr double kLine = 30;  // from one line of text to the next
constexpr std::size_t kLineColumns = 58;
constexpr std::size_t kPausesTold = 20;

struct Colour {
  std::string_view what;
  std::string_view colour;
  double up_to_m = 0;  ///< of the cross-track
};
// Told apart by those who do not see red and green, too.
constexpr std::array<Colour, 5> kCrossTrack = {{{"to 2 cm", "#1b7837", 0.02},
                                                {"to 5 cm", "#7fbf7b", 0.05},
                                                {"to 10 cm", "#e6ab02", 0.10},
                                                {"to 20 cm", "#d95f02", 0.20},
                                                {"beyond", "#7b3294", 1e9}}};
constexpr std::array<Colour, 4> kQuality = {{{"rtk fixed", "#1b7837"},
                                             {"rtk float", "#e6ab02"},
                                             {"not heard", "#7b3294"},
                                             {"other", "#d95f02"}}};

struct Point {
  double x = 0;
  double y = 0;
};

/// From the map's metres to the picture: east to the right, north up.
class Sheet {
 public:
  void include(Point at_m) {
    least_ = {std::min(least_.x, at_m.x), std::min(least_.y, at_m.y)};
    most_ = {std::max(most_.x, at_m.x), std::max(most_.y, at_m.y)};
  }
  /// After all are included; `top` is where the picture begins.
  void fit(double top) {
    if (!(least_.x <= most_.x)) least_ = most_ = {0, 0};
    const double wide_m = std::max(most_.x - least_.x, 1.0);
    const double high_m = std::max(most_.y - least_.y, 0.1);
    scale_ = std::min((kWidth - 2 * kMargin) / wide_m, (kTallest - 2 * kMargin) / high_m);
    height_ = std::max(high_m * scale_ + 2 * kMargin, kLowest);
    middle_ = {0.5 * (least_.x + most_.x), 0.5 * (least_.y + most_.y)};
    top_ = top;
  }
  Point at(Point m) const {
    return {0.5 * kWidth + scale_ * (m.x - middle_.x),
            top_ + 0.5 * height_ - scale_ * (m.y - middle_.y)};
  }
  double scale() const { return scale_; }
  double bottom() const { return top_ + height_; }

 private:
  Point least_{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point most_{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  Point middle_;
  double scale_ = 1;
  double height_ = 0;
  double top_ = 0;
};

template <class... Values>
std::string formed(const char* form, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, form, values...);
  return text;
}

std::string text_at(double x, double y, std::string_view style, std::string_view text) {
  return formed("<text x=\"%.1f\" y=\"%.1f\" ", x, y) + std::string(style) + ">" + xml_text(text) +
         "</text>\n";
}

std::string polyline(const std::vector<Point>& points, std::string_view style) {
  std::string out = "<polyline points=\"";
  for (const Point& point : points) out += formed("%.1f,%.1f ", point.x, point.y);
  return out + "\" fill=\"none\" " + std::string(style) + "/>\n";
}

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

std::vector<Point> points_of(const Node& list) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count(list); ++i)
    points.push_back({value_of(entry(entry(list, i), 0)), value_of(entry(entry(list, i), 1))});
  return points;
}

Point place_of(const Node& pause) {
  return {value_of(at(pause, "x_m")), value_of(at(pause, "y_m"))};
}

std::span<const Colour> colours(DrawnBy by) {
  if (by == DrawnBy::quality) return kQuality;
  return kCrossTrack;
}

/// Which of the colours: the columns of a driven place are named in the answer, and always these.
std::size_t colour_of(const Node& driven, DrawnBy by) {
  constexpr std::size_t kCrossTrackColumn = 3;
  constexpr std::size_t kQualityColumn = 6;
  const auto all = colours(by);
  std::size_t i = 0;
  const double off_m = std::abs(value_of(entry(driven, kCrossTrackColumn)));
  const auto quality = text(entry(driven, kQualityColumn));
  const auto is_it = [&](const Colour& one) {
    return by == DrawnBy::quality ? one.what == quality : off_m <= one.up_to_m;
  };
  while (i + 1 < all.size() && !is_it(all[i])) ++i;
  return i;
}

/// A line for each stretch of one colour, so that thousands of places are few lines.
std::string driven_lines(const Node& driven, const Sheet& sheet, DrawnBy by) {
  std::string out;
  const auto points = points_of(driven);
  std::vector<Point> stretch;
  std::size_t colour = 0;
  const auto draw = [&] {
    if (stretch.size() > 1)
      out += polyline(stretch, "stroke-width=\"4\" stroke-linecap=\"round\" stroke=\"" +
                                   std::string(colours(by)[colour].colour) + "\"");
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point here = sheet.at(points[i]);
    const std::size_t now = colour_of(entry(driven, i), by);
    if (!stretch.empty() && now != colour) {
      const Point last = stretch.back();
      draw();
      stretch = {last};
    }
    colour = now;
    stretch.push_back(here);
  }
  draw();
  return out;
}

std::string pause_marks(const Node& pauses, const Sheet& sheet) {
  std::string out;
  for (std::size_t i = 0; i < std::min(count(pauses), kPausesTold); ++i) {
    const Point at_it = sheet.at(place_of(entry(pauses, i)));
    out += formed(
        "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"13\" fill=\"#ffffff\" stroke=\"#c00000\" "
        "stroke-width=\"3\"/>\n",
        at_it.x, at_it.y);
    out += text_at(at_it.x, at_it.y + 6, "font-size=\"17\" text-anchor=\"middle\" fill=\"#c00000\"",
                   std::to_string(i + 1));
  }
  return out;
}

/// 1, 2 or 5 times a power of ten, about a quarter of the picture.
std::string scale_bar(const Sheet& sheet, double y) {
  const double wanted_m = 0.25 * kWidth / sheet.scale();
  const double power = std::pow(10.0, std::floor(std::log10(wanted_m)));
  double length_m = power;
  for (const double times : {2.0, 5.0})
    if (times * power <= wanted_m) length_m = times * power;
  const double right = kMargin + length_m * sheet.scale();
  return formed(
             "<path d=\"M%.1f %.1fv10h%.1fv-10\" fill=\"none\" stroke=\"#000000\" "
             "stroke-width=\"3\"/>\n",
             kMargin, y, length_m * sheet.scale()) +
         text_at(right + 12, y + 12, "", formed("%g m", length_m));
}

std::string north_arrow(double y) {
  const double x = kWidth - kMargin - 20;
  return formed("<path d=\"M%.1f %.1fl-10 26l10 -7l10 7z\" fill=\"#000000\"/>\n", x, y) +
         text_at(x - 34, y + 22, "", "N");
}

std::string legend(DrawnBy by, double y) {
  std::string out;
  const auto all = colours(by);
  const double step = (kWidth - 2 * kMargin) / static_cast<double>(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = kMargin + static_cast<double>(i) * step;
    out += formed("<rect x=\"%.1f\" y=\"%.1f\" width=\"22\" height=\"12\" fill=\"", x, y - 11) +
           std::string(all[i].colour) + "\"/>\n" + text_at(x + 28, y, "", all[i].what);
  }
  return out;
}

/// What was drawn so far, from the top.
class Page {
 public:
  void write(std::string_view text, std::string_view style = {}) {
    for (const auto& each : wrapped(text, kLineColumns)) {
      body_ += text_at(kMargin, y_, style, each);
      y_ += kLine;
    }
  }
  void add(std::string_view drawn) { body_ += drawn; }
  double y() const { return y_; }
  void go_to(double y) { y_ = y; }

  std::string svg(std::string_view title) const {
    return formed(
               "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
               "width=\"100%%\" font-family=\"sans-serif\" font-size=\"21\">\n",
               kWidth, y_) +
           "<title>" + xml_text(title) + "</title>\n" +
           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" + body_ + "</svg>\n";
  }

 private:
  std::string body_;
  double y_ = kMargin + 10;
};

/// The text of the report, but for the pauses, which the picture marks.
void write_figures(Page& page, const Node& answer) {
  constexpr std::size_t kLabel = 10;
  const std::string words = show_report(answer);
  std::string_view rest = words;
  while (!rest.starts_with("pauses ")) {
    const auto each = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(each.size() + 1);
    page.write(std::string(each.substr(0, each.find(' '))) + ": " +
               std::string(each.substr(kLabel)));
  }
}

/// That holds all that is drawn on it.
Sheet sheet_of(const Node& answer, double top) {
  Sheet sheet;
  const Node& drawn = at(answer, "line");
  for (const auto* line : {"track", "driven"})
    for (const Point& point : points_of(at(drawn, line))) sheet.include(point);
  const Node& pauses = at(at(answer, "report"), "pauses");
  for (std::size_t i = 0; i < count(pauses); ++i) sheet.include(place_of(entry(pauses, i)));
  sheet.fit(top);
  return sheet;
}

void draw(Page& page, const Node& answer, DrawnBy by) {
  const Sheet sheet = sheet_of(answer, page.y());
  const Node& driven = at(at(answer, "line"), "driven");
  auto track = points_of(at(at(answer, "line"), "track"));
  for (Point& point : track) point = sheet.at(point);
  page.add(polyline(track, "stroke=\"#9aa0a6\" stroke-width=\"9\" stroke-linejoin=\"round\""));
  page.add(driven_lines(driven, sheet, by));
  if (count(driven) > 0) {
    const Point end = sheet.at(points_of(driven).back());
    page.add(formed("<rect x=\"%.1f\" y=\"%.1f\" width=\"12\" height=\"12\" fill=\"#000000\"/>\n",
                    end.x - 6, end.y - 6));
  }
  page.add(pause_marks(at(at(answer, "report"), "pauses"), sheet));
  page.go_to(sheet.bottom() + kLine);
  page.add(scale_bar(sheet, page.y() - 10) + north_arrow(page.y() - 16));
  page.go_to(page.y() + 1.5 * kLine);
  page.add(legend(by, page.y()));
  page.go_to(page.y() + kLine);
  page.write(std::string("driven way by ") +
                 (by == DrawnBy::quality ? "fix quality" : "cross-track") +
                 "; grey: the track; square: its end",
             "fill=\"#5f6368\"");
}

void write_pauses(Page& page, const Node& pauses) {
  for (std::size_t i = 0; i < std::min(count(pauses), kPausesTold); ++i) {
    const Node& pause = entry(pauses, i);
    page.write(std::to_string(i + 1) + ": " + quantity(at(pause, "lasted_s"), "%.1f s") +
                   quantity(at(pause, "way_m"), " at %.1f m, ") + text(at(pause, "reason")),
               "fill=\"#c00000\"");
  }
  if (count(pauses) > kPausesTold)
    page.write("and " + std::to_string(count(pauses) - kPausesTold) + " more pauses");
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

std::string report_svg(const Node& answer, DrawnBy by) {
  Page page;
  write_figures(page, answer);
  draw(page, answer, by);
  write_pauses(page, at(at(answer, "report"), "pauses"));
  return page.svg(text(at(at(answer, "report"), "track")));
}

}  // namespace drover::cli
