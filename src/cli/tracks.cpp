#include "cli/tracks.h"

#include <cstdint>
#include <cstdio>
#include <memory>

#include "cli/client.h"
#include "cli/number_checks.h"
#include "cli/reply.h"
#include "cli/show.h"
#include "json/json_text.h"

namespace drover::cli {

namespace {

struct TrackCommand {
  std::string name;
  bool json = false;
};

struct TaskCommand {
  std::string name;
  std::int64_t id = 1;
  double speed_mps = 0.5;
  bool json = false;
};

std::string start_request(const TaskCommand& task) {
  json::JsonText out;
  out.open('{').key("cmd").text("task_start").key("name").text(task.name);
  out.key("id").integer(task.id).key("speed").number(task.speed_mps).close('}');
  return out.take();
}

/// The reason of a slip in the name is the broker's as well; here a person can look.
int start_task(const TaskCommand& task, const std::string& socket) {
  const auto answer = read_reply(ask(socket, start_request(task)));
  const int code = tell(answer, task.json);
  if (!task.json && answer.reason.starts_with("there is no track of this name"))
    std::fputs("the tracks that there are: drover traj list\n", stderr);
  return code;
}

}  // namespace

void add_track_commands(CLI::App& app, const std::string& socket, int& code) {
  const auto s = std::make_shared<TrackCommand>();
  const auto answer = [&socket](const std::string& question) {
    return read_reply(ask(socket, question));
  };
  auto* traj =
      app.add_subcommand(
             "traj",
             "saved tracks: an operator's program sends them over MQTT (src/publish/README.md)")
          ->require_subcommand(1);
  auto* list = traj->add_subcommand("list", "name, points and length of each");
  list->add_flag("--json", s->json, "one JSON object");
  list->callback([s, answer, &code] {
    code = tell_member(answer(request("traj_list")), s->json, "tracks", show_tracks);
  });
  auto* show = traj->add_subcommand("show", "the points of a track");
  show->add_option("name", s->name, "track")->required();
  show->add_flag("--json", s->json, "one JSON object");
  show->callback([s, answer, &code] {
    code = tell_member(answer(named_request("traj_show", s->name)), s->json, "track", show_track);
  });
  auto* remove = traj->add_subcommand("delete", "delete a track");
  remove->add_option("name", s->name, "track")->required();
  remove->add_flag("--json", s->json, "one JSON object");
  remove->callback(
      [s, answer, &code] { code = tell(answer(named_request("traj_delete", s->name)), s->json); });
}

void add_task_commands(CLI::App& app, const std::string& socket, int& code) {
  const auto s = std::make_shared<TaskCommand>();
  auto* task = app.add_subcommand("task", "drive a track")->require_subcommand(1);
  auto* start = task->add_subcommand("start", "drive along a track to one of its points");
  start->add_option("name", s->name, "track")->required();
  start->add_option("--id", s->id, "number of the point to stop at")
      ->required()
      ->transform(whole_number(0, UINT32_MAX));
  start->add_option("--speed", s->speed_mps, "m/s")->capture_default_str()->check(plain_number());
  start->add_flag("--json", s->json, "one JSON object");
  start->callback([s, &socket, &code] { code = start_task(*s, socket); });
  auto* cancel = task->add_subcommand("cancel", "stop");
  cancel->add_flag("--json", s->json, "one JSON object");
  cancel->callback([s, &socket, &code] {
    code = tell(read_reply(ask(socket, request("task_cancel"))), s->json);
  });
}

}  // namespace drover::cli
