// A task's report as a picture: one file, well formed whatever the names, and drawn to scale.
#include "cli/report_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "cli/svg_page.h"
#include "unit/cli/parsed.h"
#include "unit/cli/report_answer.h"

namespace drover::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string drawn(DrawnBy by = DrawnBy::cross_track) {
  return report_svg(parsed(kReportAnswer), by);
}

/// Why it is no well-formed XML, as far as an SVG of ours can err; empty: it is.
std::string malformed(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = 0; at < xml.size();) {
    if (xml[at] == '&') {
      const auto entity = xml.substr(at, xml.find(';', at) - at + 1);
      if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;" &&
          entity != "&#39;")
        return "no entity: " + entity;
    }
    if (xml[at] != '<') {
      ++at;
      continue;
    }
    const auto end = xml.find('>', at);
    if (end == std::string::npos) return "a tag without an end";
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.find('<') != std::string::npos) return "a tag in a tag: " + tag;
    const auto name = tag.substr(0, tag.find(' '));
    if (name.starts_with('/')) {
      if (open.empty() || open.back() != name.substr(1)) return "ends what is not open: " + name;
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
    at = end + 1;
  }
  return open.empty() ? "" : "is not ended: " + open.back();
}

int count_of(const std::string& text, const std::string& part) {
  int n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(PictureOfAReport, IsWellFormedWhateverTheNames) {
  for (const auto by : {DrawnBy::cross_track, DrawnBy::quality}) {
    EXPECT_EQ(malformed(drawn(by)), "");
    EXPECT_THAT(drawn(by), Not(HasSubstr("<script")));
  }
  EXPECT_THAT(drawn(), HasSubstr("<title>row &lt;7&gt; &amp; &quot;co&quot;</title>"));
}

TEST(PictureOfAReport, NeedsNothingElse) {
  for (const auto* foreign : {"href", "url(", "<style", "<image", "@import"})
    EXPECT_THAT(drawn(), Not(HasSubstr(foreign)));
}

TEST(PictureOfAReport, MarksEachPauseAndTellsItsReason) {
  EXPECT_EQ(count_of(drawn(), "<circle"), 2);
  EXPECT_THAT(drawn(), HasSubstr("1: 3.0 s at 9.5 m, person &lt;script&gt; is in the way"));
  EXPECT_THAT(drawn(), HasSubstr("2: 120.0 s at 40.2 m, an obstacle"));
}

TEST(PictureOfAReport, ColoursTheWayByWhatIsAskedFor) {
  constexpr const char* kNear = "stroke=\"#1b7837\"";
  constexpr const char* kBeside = "stroke=\"#d95f02\"";
  constexpr const char* kFloat = "stroke=\"#e6ab02\"";
  EXPECT_EQ(count_of(drawn(), kNear), 1) << "a stretch of one colour is one line";
  EXPECT_EQ(count_of(drawn(), kBeside), 1);
  EXPECT_EQ(count_of(drawn(), kFloat), 0);
  EXPECT_EQ(count_of(drawn(DrawnBy::quality), kNear), 1);
  EXPECT_EQ(count_of(drawn(DrawnBy::quality), kFloat), 1);
  EXPECT_EQ(count_of(drawn(DrawnBy::quality), kBeside), 0);
}

TEST(PictureOfAReport, CountsThePausesThatItLeavesOut) {
  std::string answer = R"({"report":{"pauses_left_out":4,"pauses":[{"lasted_s":1})";
  for (int i = 1; i < 22; ++i) answer += R"(,{"lasted_s":1})";
  EXPECT_THAT(report_svg(parsed(answer + R"(]},"line":{}})"), DrawnBy::cross_track),
              HasSubstr("and 6 more pauses"));
}

TEST(PictureOfAReport, HasAColourForACrossTrackThatNobodyKnows) {
  const auto svg = report_svg(
      parsed(R"({"report":{},"line":{"driven":[[0,0,0,null],[5,0,5,null],[9,0,9,0.01]]}})"),
      DrawnBy::cross_track);
  EXPECT_EQ(count_of(svg, "stroke-linecap=\"round\" stroke=\"#000000\""), 1);
  EXPECT_EQ(count_of(svg, "stroke=\"#1b7837\""), 1);
  EXPECT_THAT(svg, HasSubstr(">not known</text>"));
}

TEST(PictureOfAReport, BreaksTheWayWhereNoPlaceIsKnown) {
  const auto svg = report_svg(
      parsed(R"({"report":{"pauses":[{"x_m":null,"y_m":null,"reason":"no place"}]},"line":{)"
             R"("track":[[100,100],[120,100]],"driven":[[100,100,0,0],[104,100,4,0],)"
             R"([null,null,5,0],[110,100,10,0],[114,100,14,0],[null,null,15,0]]}})"),
      DrawnBy::cross_track);
  EXPECT_EQ(malformed(svg), "");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(count_of(svg, "stroke=\"#1b7837\""), 2);
  EXPECT_THAT(svg, HasSubstr("v10h162.0v-10")) << "(0, 0) is far away, and not in it";
  EXPECT_EQ(count_of(svg, "<circle"), 0);
  EXPECT_THAT(svg, HasSubstr("no place")) << "told all the same";
}

TEST(PictureOfAReport, HasAScaleThatIsTrue) {
  // 20 m of track are 648 wide: 5 m are 162.
  EXPECT_THAT(drawn(), HasSubstr(">5 m</text>"));
  EXPECT_THAT(drawn(), HasSubstr("v10h162.0v-10"));
  EXPECT_THAT(drawn(), HasSubstr(">N</text>"));
}

TEST(PictureOfAReport, HasEastRightAndNorthUp) {
  const std::string svg = drawn();
  const auto at = svg.find("points=\"") + 8;
  double x[3] = {};
  double y[3] = {};
  ASSERT_EQ(
      std::sscanf(svg.c_str() + at, "%lf,%lf %lf,%lf %lf,%lf", x, y, x + 1, y + 1, x + 2, y + 2),
      6);
  EXPECT_GT(x[1], x[0]);
  EXPECT_EQ(y[1], y[0]);
  EXPECT_EQ(x[2], x[1]);
  EXPECT_LT(y[2], y[1]);
}

TEST(PictureOfAReport, IsDrawnOfATaskThatNeverMoved) {
  const auto svg = report_svg(parsed(R"({"report":{"track":"a","pauses":[]},"line":{"track":[],)"
                                     R"("driven":[]}})"),
                              DrawnBy::cross_track);
  EXPECT_EQ(malformed(svg), "");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(PictureOfAReport, BreaksALongReasonBetweenItsWords) {
  const std::string word = "reason ";
  std::string reason;
  for (int i = 0; i < 20; ++i) reason += word;
  const auto svg =
      report_svg(parsed(R"({"report":{"pauses":[{"reason":")" + reason + R"("}]},"line":{}})"),
                 DrawnBy::cross_track);
  EXPECT_THAT(svg, Not(HasSubstr(reason)));
  EXPECT_EQ(count_of(svg, "reason"), 20) << "no word is cut";
}

TEST(XmlText, ReplacesWhatXmlDoesNotAllow) {
  EXPECT_EQ(xml_text("a\x01"
                     "b"),
            "a\xEF\xBF\xBD"
            "b");
  EXPECT_EQ(xml_text("\xFF"), "\xEF\xBF\xBD");
  EXPECT_EQ(xml_text("Fläche 'ß'"), "Fläche &#39;ß&#39;");
}

}  // namespace
}  // namespace drover::cli
