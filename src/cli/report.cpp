#include "cli/report.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "cli/client.h"
#include "cli/exit_codes.h"
#include "cli/failure.h"
#include "cli/number_checks.h"
#include "cli/reply.h"
#include "cli/report_svg.h"
#include "cli/show_report.h"
#include "json/json_text.h"

namespace drover::cli {

namespace {

struct ReportSettings {
  std::int64_t number = 0;  ///< 0: the last task's
  bool list = false;
  bool json = false;
  std::string svg;  ///< file
  std::string colour = "cross-track";
};

std::string report_request(std::int64_t number) {
  json::JsonText out;
  out.open('{').key("cmd").text("report");
  if (number != 0) out.key("number").integer(number);
  return out.close('}').take();
}

/// Empty: it is written.
std::string write_file(const std::string& path, const std::string& text) {
  const auto trouble = [&] { return "cannot write " + path + ": " + std::strerror(errno); };
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (file == nullptr) return trouble();
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  // A full disk may be told only here.
  const bool closed = std::fclose(file) == 0;
  return written && closed ? "" : trouble();
}

int tell_report(const ReportSettings& settings, const std::string& socket) {
  const auto answer = read_reply(ask(socket, report_request(settings.number), kDiskPatience_s));
  if (!settings.svg.empty() && answer.done) {
    const auto by = settings.colour == "quality" ? DrawnBy::quality : DrawnBy::cross_track;
    const auto trouble = write_file(settings.svg, report_svg(answer.document.root, by));
    if (!trouble.empty()) {
      tell_failure(settings.json, "drover", trouble);
      return kRefused;
    }
    if (!settings.json) {
      std::printf("written to %s\n", settings.svg.c_str());
      return kDone;
    }
  }
  return tell(answer, settings.json, show_report);
}

}  // namespace

void add_report_command(CLI::App& app, const std::string& socket, int& code) {
  const auto settings = std::make_shared<ReportSettings>();
  auto* command = app.add_subcommand(
      "report", "what became of a task: cross-track, speed, fix quality, pauses");
  auto* number = command->add_option("number", settings->number, "of the report; else the last");
  number->transform(whole_number(1, INT64_MAX));
  auto* list = command->add_flag("--list", settings->list, "all that are kept, the newest first");
  list->excludes(number);
  command->add_flag("--json", settings->json, "one JSON object, with the way that was driven");
  auto* svg = command->add_option("--svg", settings->svg, "write a picture to this file");
  svg->excludes(list);
  command->add_option("--colour", settings->colour, "of the driven way in the picture")
      ->capture_default_str()
      ->needs(svg)
      ->check(CLI::IsMember({"cross-track", "quality"}));
  command->callback([settings, &socket, &code] {
    if (settings->list) {
      const auto answer = read_reply(ask(socket, request("report_list"), kDiskPatience_s));
      code = tell(answer, settings->json, show_reports);
    } else {
      code = tell_report(*settings, socket);
    }
  });
}

}  // namespace drover::cli
