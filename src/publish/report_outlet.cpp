#include "publish/report_outlet.h"

#include <algorithm>

#include "json/json_text.h"
#include "json/located_json.h"
#include "publish/line_json.h"
#include "publish/report/report_text.h"

namespace drover::publish {
namespace {

/// What waits for the disk at once: who asks in a loop is told so.
constexpr std::size_t kMostQuestions = 8;

/// {"number":N,"report":SUMMARY}; texts of the store stand as they are.
std::string entry_text(const store::StoredReport& report) {
  return "{\"number\":" + std::to_string(report.number) + ",\"report\":" + report.texts.summary +
         "}";
}

/// `problem`: what is missing before the first of them.
std::string list_line(const std::vector<store::StoredReport>& reports, std::string_view problem) {
  std::string line = R"({"ok":true,"reports":[)";
  for (const auto& report : reports) {
    if (&report != &reports.front()) line += ',';
    line += entry_text(report);
  }
  return line + "],\"problem\":" + json::JsonText().text(problem).take() + "}";
}

std::string report_line(const store::StoredReport& report) {
  return R"({"ok":true,"number":)" + std::to_string(report.number) +
         ",\"report\":" + report.texts.summary + ",\"line\":" + report.texts.line + "}";
}

}  // namespace

std::vector<OutMessage> ReportOutlet::on_snapshot(const Snapshot& seen, const Moment& moment,
                                                  Actions& /*out*/) {
  wall_minus_monotonic_ = moment.wall_minus_monotonic;
  if (recorder_) recorder_->take(seen);
  return {};
}

void ReportOutlet::on_event(const Event& event, Actions& out) {
  if (const auto* accepted = std::get_if<CommandAccepted>(&event.body)) {
    begin(accepted->id, event.time);
  } else if (const auto* stuck = std::get_if<NavigationNotStarted>(&event.body)) {
    end(stuck->id, event.time, false, TaskEnded::How::failed, stuck->reason.view(), out);
  } else if (const auto* ended = std::get_if<TaskEnded>(&event.body)) {
    end(ended->id, event.time, true, ended->how, ended->reason.view(), out);
  }
}

void ReportOutlet::begin(RequestId id, Time now) {
  const auto task = service_.given_task(id);
  if (!task) return;  // another command's
  task_ = id;
  recorder_.emplace(*task, now, now.time_since_epoch() + wall_minus_monotonic_);
}

void ReportOutlet::end(RequestId id, Time now, bool begun, TaskEnded::How how,
                       std::string_view reason, Actions& out) {
  if (!recorder_ || id.source != task_.source || id.number != task_.number) return;
  auto texts = report_texts(recorder_->end(now, begun, how, reason));
  recorder_.reset();
  out.emplace_back(store::StorageJob{next_id(), store::SaveReport{std::move(texts)}});
}

bool ReportOutlet::on_line(ClientId client, std::string_view line, Time /*now*/, Actions& out) {
  const auto document = json::parse(line, {.max_bytes = 1024, .max_depth = 2, .max_values = 8});
  if (!document) return false;
  const auto cmd = text_member(document->root, "cmd");
  const auto reply = [&](std::string_view reason) {
    out.emplace_back(Reply{client, reply_line(false, reason)});
    return true;
  };
  if (cmd != "report" && cmd != "report_list") return false;
  if (questions_.size() >= kMostQuestions || (cmd == "report_list" && list_waits()))
    return reply("the disk is behind, try again");
  const RequestId id = next_id();
  Question question{client, cmd == "report_list"};
  if (question.of_list) {
    out.emplace_back(store::StorageJob{id, store::ListReports{}});
  } else {
    const auto* number = document->root.find("number");
    const auto wanted = number == nullptr ? 0 : number->integer();
    if (!wanted) return reply("number is no whole number");
    if (*wanted < 0) return reply("number is below zero: reports are numbered from one");
    out.emplace_back(store::StorageJob{id, store::ReadReport{static_cast<std::uint64_t>(*wanted)}});
    question.of_last = *wanted == 0;
  }
  questions_[id.number] = question;
  return true;
}

/// Of lists the disk reads one at a time: a stop that is to be kept waits behind it.
bool ReportOutlet::list_waits() const {
  return std::any_of(questions_.begin(), questions_.end(),
                     [](const auto& one) { return one.second.of_list; });
}

void ReportOutlet::on_stored(const store::StorageReply& reply, Actions& out) {
  const auto found = questions_.find(reply.id.number);
  if (found == questions_.end()) return on_saved(reply, out);
  const Question question = found->second;
  questions_.erase(found);
  std::string line;
  if (question.of_last && !lost_.empty()) {
    line = reply_line(false, lost_ + "; those before it: drover report --list");
  } else if (!reply.ok) {
    line = reply_line(false, reply.reason);
  } else {
    line = question.of_list ? list_line(reply.reports, lost_) : report_line(reply.reports.front());
  }
  out.emplace_back(Reply{question.client, std::move(line)});
}

void ReportOutlet::on_saved(const store::StorageReply& reply, Actions& out) {
  lost_ = reply.ok ? "" : "the last task's report is lost: " + reply.reason;
  if (!reply.ok) out.emplace_back(LogLine{Notice::Level::warning, lost_});
}

}  // namespace drover::publish
