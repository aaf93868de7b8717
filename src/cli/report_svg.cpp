#include "cli/report_svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

#include "cli/layout.h"
#include "cli/show_report.h"
#include "cli/svg_page.h"
#include "text/number.h"

namespace drover::cli {
namespace {

using json::Node;

constexpr double kTallest = 900;
constexpr double kLowest = 160;
constexpr std::size_t kPausesTold = 20;

struct Colour {
  std::string_view what;
  std::string_view colour;
  double up_to_m = 0;  ///< of the cross-track
};
// Told apart by those who do not see red and green, too.
constexpr std::array<Colour, 6> kCrossTrack = {{{"to 2 cm", "#1b7837", 0.02},
                                                {"to 5 cm", "#7fbf7b", 0.05},
                                                {"to 10 cm", "#e6ab02", 0.10},
                                                {"to 20 cm", "#d95f02", 0.20},
                                                {"beyond", "#7b3294", INFINITY},
                                                {"not known", "#000000"}}};
constexpr std::array<Colour, 4> kQuality = {{{"rtk fixed", "#1b7837"},
                                             {"rtk float", "#e6ab02"},
                                             {"not heard", "#7b3294"},
                                             {"other", "#d95f02"}}};

/// In metres, as the answer has it: not finite where a place is not known.
struct MapPlace {
  double x_m = 0;
  double y_m = 0;
  bool is_known() const { return std::isfinite(x_m) && std::isfinite(y_m); }
};

/// From the map's metres to the picture: east to the right, north up.
class Sheet {
 public:
  /// A place that is not known needs no room.
  void include(MapPlace place) {
    if (!place.is_known()) return;
    least_ = {std::min(least_.x_m, place.x_m), std::min(least_.y_m, place.y_m)};
    most_ = {std::max(most_.x_m, place.x_m), std::max(most_.y_m, place.y_m)};
  }
  /// After all are included; `top` is where the picture begins.
  void fit(double top) {
    if (!(least_.x_m <= most_.x_m)) least_ = most_ = {0, 0};
    const double wide_m = std::max(most_.x_m - least_.x_m, 1.0);
    const double high_m = std::max(most_.y_m - least_.y_m, 0.1);
    scale_ =
        std::min((kPageWidth - 2 * kPageMargin) / wide_m, (kTallest - 2 * kPageMargin) / high_m);
    height_ = std::max(high_m * scale_ + 2 * kPageMargin, kLowest);
    middle_ = {0.5 * (least_.x_m + most_.x_m), 0.5 * (least_.y_m + most_.y_m)};
    top_ = top;
  }
  PagePoint at(MapPlace place) const {
    return {0.5 * kPageWidth + scale_ * (place.x_m - middle_.x_m),
            top_ + 0.5 * height_ - scale_ * (place.y_m - middle_.y_m)};
  }
  double scale() const { return scale_; }
  double bottom() const { return top_ + height_; }

 private:
  MapPlace least_{INFINITY, INFINITY};
  MapPlace most_{-INFINITY, -INFINITY};
  MapPlace middle_;
  double scale_ = 1;
  double height_ = 0;
  double top_ = 0;
};

MapPlace place_of(const Node& x_m, const Node& y_m) {
  return {x_m.number().value_or(NAN), y_m.number().value_or(NAN)};
}

MapPlace place_of(const Node& pause) {
  return place_of(at(pause, "x_m"), at(pause, "y_m"));
}

/// Of a list of the answer; one without a place is kept, as a gap.
std::vector<MapPlace> places_of(const Node& list) {
  std::vector<MapPlace> places;
  for (std::size_t i = 0; i < count(list); ++i)
    places.push_back(place_of(entry(entry(list, i), 0), entry(entry(list, i), 1)));
  return places;
}

std::span<const Colour> colours(DrawnBy by) {
  if (by == DrawnBy::quality) return kQuality;
  return kCrossTrack;
}

/// Which of the colours, the last for none of the others: the columns of a driven place are named
/// in the answer, and always these.
std::size_t colour_of(const Node& driven, DrawnBy by) {
  constexpr std::size_t kCrossTrackColumn = 3;
  constexpr std::size_t kQualityColumn = 6;
  const auto all = colours(by);
  std::size_t i = 0;
  const double off_m = std::abs(entry(driven, kCrossTrackColumn).number().value_or(NAN));
  const auto quality = text(entry(driven, kQualityColumn));
  const auto is_it = [&](const Colour& one) {
    return by == DrawnBy::quality ? one.what == quality : off_m <= one.up_to_m;
  };
  while (i + 1 < all.size() && !is_it(all[i])) ++i;
  return i;
}

/// A line for each stretch of one colour, so that thousands of places are few lines. Nobody knows
/// what lies between two of which one has no place.
std::string driven_lines(const Node& driven, const Sheet& sheet, DrawnBy by) {
  std::string out;
  const auto places = places_of(driven);
  std::vector<PagePoint> stretch;
  std::size_t colour = 0;
  const auto draw = [&] {
    if (stretch.size() > 1)
      out += polyline(stretch, "stroke-width=\"4\" stroke-linecap=\"round\" stroke=\"" +
                                   std::string(colours(by)[colour].colour) + "\"");
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!places[i].is_known()) {
      draw();
      stretch.clear();
      continue;
    }
    const PagePoint here = sheet.at(places[i]);
    const std::size_t now = colour_of(entry(driven, i), by);
    if (!stretch.empty() && now != colour) {
      const PagePoint last = stretch.back();
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
    const MapPlace place = place_of(entry(pauses, i));
    if (!place.is_known()) continue;
    const PagePoint at_it = sheet.at(place);
    out += "<circle cx=\"" + px(at_it.x) + "\" cy=\"" + px(at_it.y) +
           "\" r=\"13\" fill=\"#ffffff\" stroke=\"#c00000\" stroke-width=\"3\"/>\n";
    out += text_at(at_it.x, at_it.y + 6, "font-size=\"17\" text-anchor=\"middle\" fill=\"#c00000\"",
                   std::to_string(i + 1));
  }
  return out;
}

/// 1, 2 or 5 times a power of ten, about a quarter of the picture.
std::string scale_bar(const Sheet& sheet, double y) {
  const double wanted_m = 0.25 * kPageWidth / sheet.scale();
  const double power = std::pow(10.0, std::floor(std::log10(wanted_m)));
  double length_m = power;
  for (const double times : {2.0, 5.0})
    if (times * power <= wanted_m) length_m = times * power;
  const double length = length_m * sheet.scale();
  return "<path d=\"M" + px(kPageMargin) + " " + px(y) + "v10h" + px(length) +
         "v-10\" fill=\"none\" stroke=\"#000000\" stroke-width=\"3\"/>\n" +
         text_at(kPageMargin + length + 12, y + 12, "", text::formed("%g m", length_m));
}

std::string north_arrow(double y) {
  const double x = kPageWidth - kPageMargin - 20;
  return "<path d=\"M" + px(x) + " " + px(y) + "l-10 26l10 -7l10 7z\" fill=\"#000000\"/>\n" +
         text_at(x - 34, y + 22, "", "N");
}

std::string legend(DrawnBy by, double y) {
  std::string out;
  const auto all = colours(by);
  const double step = (kPageWidth - 2 * kPageMargin) / static_cast<double>(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = kPageMargin + static_cast<double>(i) * step;
    out += "<rect x=\"" + px(x) + "\" y=\"" + px(y - 11) + "\" width=\"22\" height=\"12\" fill=\"" +
           std::string(all[i].colour) + "\"/>\n" +
           text_at(x + 26, y, "font-size=\"17\"", all[i].what);
  }
  return out;
}

/// The text of the report, but for the pauses, which the picture marks.
void write_figures(Page& page, const Node& answer) {
  for (const auto& [label, words] : figures(answer)) page.write(std::string(label) + ": " + words);
}

/// That holds all that is drawn on it.
Sheet sheet_of(const Node& answer, double top) {
  Sheet sheet;
  const Node& drawn = at(answer, "line");
  for (const auto* line : {"track", "driven"})
    for (const MapPlace& place : places_of(at(drawn, line))) sheet.include(place);
  const Node& pauses = at(at(answer, "report"), "pauses");
  for (std::size_t i = 0; i < count(pauses); ++i) sheet.include(place_of(entry(pauses, i)));
  sheet.fit(top);
  return sheet;
}

/// Empty where no place of the way is known.
std::string end_mark(const std::vector<MapPlace>& driven, const Sheet& sheet) {
  const auto last = std::find_if(driven.rbegin(), driven.rend(),
                                 [](const MapPlace& one) { return one.is_known(); });
  if (last == driven.rend()) return "";
  const PagePoint end = sheet.at(*last);
  return "<rect x=\"" + px(end.x - 6) + "\" y=\"" + px(end.y - 6) +
         "\" width=\"12\" height=\"12\" fill=\"#000000\"/>\n";
}

void draw(Page& page, const Node& answer, DrawnBy by) {
  const Sheet sheet = sheet_of(answer, page.y());
  const Node& driven = at(at(answer, "line"), "driven");
  std::vector<PagePoint> track;
  for (const MapPlace& place : places_of(at(at(answer, "line"), "track")))
    if (place.is_known()) track.push_back(sheet.at(place));
  page.add(polyline(track, "stroke=\"#9aa0a6\" stroke-width=\"9\" stroke-linejoin=\"round\""));
  page.add(driven_lines(driven, sheet, by));
  page.add(end_mark(places_of(driven), sheet));
  page.add(pause_marks(at(at(answer, "report"), "pauses"), sheet));
  page.go_to(sheet.bottom() + kPageLine);
  page.add(scale_bar(sheet, page.y() - 10) + north_arrow(page.y() - 16));
  page.go_to(page.y() + 1.5 * kPageLine);
  page.add(legend(by, page.y()));
  page.go_to(page.y() + kPageLine);
  page.write(std::string("driven way by ") +
                 (by == DrawnBy::quality ? "fix quality" : "cross-track") +
                 "; grey: the track; square: its end",
             "fill=\"#5f6368\"");
}

void write_pauses(Page& page, const Node& report) {
  const Node& pauses = at(report, "pauses");
  for (std::size_t i = 0; i < std::min(count(pauses), kPausesTold); ++i) {
    const Node& pause = entry(pauses, i);
    page.write(std::to_string(i + 1) + ": " + quantity(at(pause, "lasted_s"), "%.1f s") +
                   quantity(at(pause, "way_m"), " at %.1f m, ") + text(at(pause, "reason")),
               "fill=\"#c00000\"");
  }
  const std::size_t all =
      count(pauses) + static_cast<std::size_t>(value_of(at(report, "pauses_left_out")));
  if (all > kPausesTold)
    page.write("and " + text::counted(all - kPausesTold, "more pause", "more pauses"));
}

}  // namespace

std::string report_svg(const Node& answer, DrawnBy by) {
  Page page;
  write_figures(page, answer);
  draw(page, answer, by);
  write_pauses(page, at(answer, "report"));
  return page.svg(text(at(at(answer, "report"), "track")));
}

}  // namespace drover::cli
