#include "cli/learned.h"

#include <memory>

#include "cli/client.h"
#include "cli/reply.h"
#include "cli/show_learned.h"

namespace drover::cli {

void add_learned_commands(CLI::App& app, const std::string& socket, int& code) {
  const auto json = std::make_shared<bool>(false);
  auto* learned = app.add_subcommand("learned", "what drives taught the robot of itself");
  learned->require_subcommand(1);
  const auto add = [&](const char* verb, const char* what) {
    auto* added = learned->add_subcommand(verb, what);
    added->add_flag("--json", *json, "one JSON object");
    return added;
  };
  add("show", "each value beside its key in the configuration")->callback([&socket, &code, json] {
    code = tell(read_reply(ask(socket, request("learned"))), *json, show_learned);
  });
  add("forget", "learn it anew: a wheel, a tyre or an antenna was changed")
      ->callback([&socket, &code, json] {
        code = tell(read_reply(ask(socket, request("learned_forget"))), *json);
      });
}

}  // namespace drover::cli
