#include "cli/scene.h"

#include <memory>

#include "cli/client.h"
#include "cli/reply.h"
#include "cli/show_scene.h"

namespace drover::cli {

namespace {

struct SceneCommand {
  std::string name;
  bool json = false;
};

}  // namespace

void add_scene_commands(CLI::App& app, const std::string& socket, int& code) {
  const auto command = std::make_shared<SceneCommand>();
  const auto add = [&](CLI::App& to, const char* verb, const char* what) {
    auto* added = to.add_subcommand(verb, what);
    added->add_flag("--json", command->json, "one JSON object");
    return added;
  };
  const auto run = [&socket, &code, command](const std::string& question, const Show& show) {
    code = tell(read_reply(ask(socket, question, kDiskPatience_s)), command->json, show);
  };
  auto* scene = app.add_subcommand("scene", "objects around the robot, and constraints on it");
  scene->require_subcommand(1);
  add(*scene, "list", "each object and each set of constraints, and whether they are known")
      ->callback([run] { run(request("scene_list"), show_scene); });
  auto* show = add(*scene, "show", "the shapes of an object, or a set of constraints");
  show->add_option("name", command->name, "id of the object, name of the set")->required();
  show->callback(
      [run, command] { run(named_request("scene_show", command->name), show_scene_entry); });
  add(*scene, "clear", "remove all objects and constraints; zones stay")->callback([run] {
    run(request("scene_clear"), nullptr);
  });
  add(*scene, "accept-loss", "go on without what was stored and cannot be read any more")
      ->callback([run] { run(request("scene_accept_loss"), nullptr); });
}

}  // namespace drover::cli
