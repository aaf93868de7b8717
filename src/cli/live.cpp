#include "cli/live.h"

#include <unistd.h>

#include <cstdio>
#include <deque>

#include "cli/client.h"
#include "cli/exit_codes.h"
#include "cli/failure.h"
#include "cli/layout.h"
#include "cli/rates.h"

namespace drover::cli {

namespace {

using json::Node;

constexpr useconds_t kRedraw_us = 200'000;
constexpr useconds_t kLines_us = 1'000'000;
/// Rates are taken over so many seconds; a battery is asked about once a second.
constexpr double kWindow_s = 3;

/// Throws NoAnswer when it is not understood.
Node ask_status(const std::string& socket) {
  const auto reply = ask(socket, R"({"cmd":"status"})");
  const auto document = json::parse(reply);
  if (!document) throw NoAnswer{"the answer is not understood: " + document.error().text()};
  return at(document->root, "status");
}

double time_s(const Node& status) {
  return at(status, "time_s").number().value_or(0);
}

/// The view's parts of the status and nothing else.
std::string json_of(const DeviceView& view, const Node& status) {
  Node out;
  std::vector<json::Member> members;
  members.push_back({"ok", 0, 0, Node{.value = true}});
  members.push_back({"time_s", 0, 0, at(status, "time_s")});
  for (const auto part : view.parts)
    if (const auto* node = status.find(part)) members.push_back({std::string(part), 0, 0, *node});
  out.value = std::move(members);
  return json_line(out) + "\n";
}

}  // namespace

int show_live(const DeviceView& view, const LiveSettings& settings) {
  std::deque<Node> past{ask_status(settings.socket)};
  if (const auto why = missing(view, past.front()); !why.empty()) {
    tell_failure(settings.json, "refused", why);
    return kRefused;
  }
  const bool redraw = settings.watch && !settings.json && ::isatty(STDOUT_FILENO) != 0;
  do {
    // Two answers make a rate. The battery's come more slowly.
    ::usleep(redraw                                  ? kRedraw_us
             : view.name == "bms" && !settings.watch ? 2 * kLines_us
                                                     : kLines_us);
    Node status = ask_status(settings.socket);
    const Node plain = status;
    add_rates(status, past.front());
    past.push_back(plain);
    while (past.size() > 1 && time_s(plain) - time_s(past.front()) > kWindow_s) past.pop_front();
    if (redraw) std::fputs("\033[H\033[2J", stdout);
    std::fputs((settings.json ? json_of(view, status) : view.show(status)).c_str(), stdout);
    std::fflush(stdout);
  } while (settings.watch);
  return kDone;
}

}  // namespace drover::cli
