#include "cli/zone.h"

#include <unistd.h>

#include <iostream>
#include <memory>

#include "cli/client.h"
#include "cli/exit_codes.h"
#include "cli/option_texts.h"
#include "cli/reply.h"
#include "cli/show_zones.h"
#include "cli/zone_import.h"

namespace drover::cli {

namespace {

struct ZoneCommand {
  ImportOrder order;
  bool keep_out = false;
  std::string name;
  bool json = false;
};

std::optional<std::string> ask_person(const std::string& question) {
  if (::isatty(STDIN_FILENO) == 0) return std::nullopt;
  std::cerr << question << std::flush;
  std::string said;
  std::getline(std::cin, said);
  return said;
}

void add_import(CLI::App& zone, const std::string& socket, int& code,
                const std::shared_ptr<ZoneCommand>& command) {
  auto* verb = zone.add_subcommand("import", "a polygon from a file, after you have looked at it");
  auto& order = command->order;
  verb->add_option("file", order.file, "GeoJSON or KML, up to 2 MiB")->required();
  auto* keep_in = verb->add_flag("--keep-in", order.keep_in, "the whole robot stays inside");
  verb->add_flag("--keep-out", command->keep_out, "nothing of the robot comes into it")
      ->excludes(keep_in);
  auto* name = verb->add_option("--name", order.name, "instead of the name in the file");
  verb->add_flag("--yes", order.yes, "do not ask: somebody has looked where it is");
  verb->add_flag("--json", order.json, "one JSON object; with --yes");
  verb->callback([&socket, &code, command, name] {
    if (name->count() > 0 && command->order.name.empty())
      throw WrongUsage("--name is empty: leave it out for the name in the file");
    if (!command->order.keep_in && !command->keep_out)
      throw WrongUsage("say --keep-in when it stays inside, --keep-out when it stays outside");
    const ImportTalk talk{
        [&socket](const std::string& question) { return ask(socket, question, kDiskPatience_s); },
        ask_person};
    code = import_zone_file(command->order, talk, std::cout, std::cerr);
  });
}

}  // namespace

void add_zone_commands(CLI::App& app, const std::string& socket, int& code) {
  const auto command = std::make_shared<ZoneCommand>();
  const auto run = [&socket, &code, command](const std::string& question, const Show& show) {
    code = tell(read_reply(ask(socket, question, kDiskPatience_s)), command->json, show);
  };
  auto* zone = app.add_subcommand("zone", "where the robot may be, and where not");
  zone->require_subcommand(1);
  add_import(*zone, socket, code, command);
  auto* list = zone->add_subcommand("list", "each zone with its size and its distance");
  list->add_flag("--json", command->json, "one JSON object");
  list->callback([run] { run(request("zone_list"), show_zones); });
  auto* remove = zone->add_subcommand("delete", "delete a zone: THE FENCE IS GONE");
  remove->add_option("name", command->name, "zone")->required();
  remove->add_flag("--json", command->json, "one JSON object");
  remove->callback([run, command, &socket, &code] {
    run(named_request("zone_delete", command->name), nullptr);
    if (code != kDone || command->json) return;
    std::cout << std::flush;
    try {
      std::cerr << bounds_nothing(read_reply(ask(socket, request("zone_list"))).document.root);
    } catch (const NoAnswer&) {  // it is deleted all the same
    }
  });
  auto* forget = zone->add_subcommand(
      "forget-unreadable", "put a file of zones aside that cannot be read: THERE IS NO FENCE THEN");
  forget->add_flag("--json", command->json, "one JSON object");
  forget->callback([run] { run(request("zone_forget_unreadable"), nullptr); });
}

}  // namespace drover::cli
