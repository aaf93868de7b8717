// The folder of task reports: one file each, numbered, the oldest dropped.
#include "store/report_store.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <string_view>

#include "json/located_json.h"

namespace drover::store {
namespace {

constexpr std::string_view kReportFormat = "drover task report";
constexpr int kReportVersion = 1;
constexpr std::string_view kEnding = ".report";
// The two texts as one list, each on a line of its own.
constexpr std::string_view kOpen = "[";
constexpr std::string_view kBetween = ",\n";
constexpr std::string_view kClose = "]";
constexpr std::size_t kFront = 64 * 1024;  // has all of a summary but the longest

std::string file_name(std::uint64_t number) {
  char digits[24];
  std::snprintf(digits, sizeof digits, "%06llu", static_cast<unsigned long long>(number));
  return digits + std::string(kEnding);
}

/// 0: it is none of a report.
std::uint64_t number_of(std::string_view file) {
  if (!file.ends_with(kEnding)) return 0;
  const auto digits = file.substr(0, file.size() - kEnding.size());
  std::uint64_t number = 0;
  const auto* end = digits.data() + digits.size();
  const auto read = std::from_chars(digits.data(), end, number);
  return read.ec == std::errc() && read.ptr == end && file_name(number) == file ? number : 0;
}

/// Of a body, or of so much of its begin.
std::optional<std::string_view> summary_in(std::string_view body) {
  const auto between = body.find(kBetween);
  if (!body.starts_with(kOpen) || between == body.npos) return std::nullopt;
  return body.substr(kOpen.size(), between - kOpen.size());
}

Result<ReportTexts, Failure> decode(std::string_view content) {
  const auto body = unseal(kReportFormat, kReportVersion, content);
  if (!body.ok()) return body.error();
  std::string_view text = *body;
  const auto summary = summary_in(text);
  if (!summary || !text.ends_with(kClose)) return Failure{"is no report"};
  text.remove_prefix(kOpen.size() + summary->size() + kBetween.size());
  text.remove_suffix(kClose.size());
  return ReportTexts{std::string(*summary), std::string(text)};
}

}  // namespace

ReportStore::ReportStore(Files& files, std::string folder)
    : files_(files), folder_(std::move(folder)) {}

/// Ascending. A folder that cannot be read has none.
std::vector<std::uint64_t> ReportStore::numbers() const {
  std::vector<std::string> names;
  std::vector<std::uint64_t> numbers;
  if (files_.list(folder_, names) != 0) return numbers;
  for (const auto& name : names)
    if (const auto number = number_of(name); number != 0) numbers.push_back(number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// Of saves that a power cut interrupted.
void ReportStore::remove_leftovers() {
  std::vector<std::string> names;
  if (files_.list(folder_, names) != 0) return;
  for (const auto& name : names)
    if (name.ends_with(kTemporaryEnding)) files_.remove(path(name));
}

std::optional<Failure> ReportStore::save(const ReportTexts& texts) {
  std::string body(kOpen);
  body += texts.summary;
  body += kBetween;
  body += texts.line;
  body += kClose;
  const std::string content = seal(kReportFormat, kReportVersion, body);
  if (content.size() > kMaxReportBytes)
    return Failure{"it has more than " + std::to_string(kMaxReportBytes) + " bytes"};
  remove_leftovers();
  const auto there = numbers();
  const std::uint64_t number = there.empty() ? 1 : there.back() + 1;
  if (auto failure = write_durably(files_, folder_, file_name(number), content)) return failure;
  // A name that comes back after a power cut is dropped by the next save.
  for (std::size_t i = 0; i + kMaxReports < there.size() + 1; ++i)
    files_.remove(path(file_name(there[i])));
  return std::nullopt;
}

std::vector<StoredReport> ReportStore::list() const {
  std::vector<StoredReport> reports;
  auto there = numbers();
  std::reverse(there.begin(), there.end());
  for (const auto number : there) {
    if (auto one = summary(number)) reports.push_back({number, {std::move(*one), {}}});
  }
  return reports;
}

std::optional<std::string> ReportStore::summary(std::uint64_t number) const {
  std::string content;
  if (files_.read_front(path(file_name(number)), kFront, content) != 0) return std::nullopt;
  const auto front = unseal_front(kReportFormat, kReportVersion, content);
  if (!front.ok()) return std::nullopt;
  if (const auto found = summary_in(*front)) {
    if (!json::parse(*found).ok()) return std::nullopt;
    return std::string(*found);
  }
  auto whole = read(number);  // one that is longer than others are
  if (!whole.ok()) return std::nullopt;
  return std::move(whole.value().texts.summary);
}

Result<StoredReport, Failure> ReportStore::read(std::uint64_t number) const {
  if (number == 0) {
    const auto there = numbers();
    if (there.empty()) return Failure{"there is no report yet: no task has ended"};
    number = there.back();
  }
  const auto file = path(file_name(number));
  std::string content;
  if (const int e = files_.read(file, kMaxReportBytes, content); e == ENOENT) {
    return Failure{"there is no report " + std::to_string(number)};
  } else if (e != 0) {
    return Failure{failure_text("read", file, e)};
  }
  auto texts = decode(content);
  if (!texts.ok()) return Failure{file + " " + texts.error().text};
  return StoredReport{number, std::move(texts.value())};
}

}  // namespace drover::store
