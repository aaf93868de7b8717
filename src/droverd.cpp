// droverd: the gateway between a field robot's hardware and everything that commands or watches it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "config/load.h"
#include "config/register_map.h"
#include "runtime/daemon.h"

namespace {

// systemd does not start again after it (RestartPreventExitStatus=): no retry would help.
constexpr int kBadConfiguration = 2;

/// False when there are problems; each is a line on stderr. Behind them the new text of old
/// sections.
bool report(const drover::config::Loaded& loaded, const std::string& file) {
  for (const auto& problem : loaded.problems)
    std::fprintf(stderr, "%s\n", problem.text(file).c_str());
  if (!loaded.new_sections.empty())
    std::fprintf(stderr, "%s: put this in their stead:\n%s\n", file.c_str(),
                 loaded.new_sections.c_str());
  return loaded.problems.empty();
}

int check(const std::string& file) {
  const auto loaded = drover::config::load_file(file);
  for (const auto& warning : loaded.warnings)
    std::fprintf(stderr, "warning: %s\n", warning.text(file).c_str());
  if (!report(loaded, file)) {
    std::fprintf(stderr, "%s: %zu problem%s\n", file.c_str(), loaded.problems.size(),
                 loaded.problems.size() == 1 ? "" : "s");
    return kBadConfiguration;
  }
  const auto& config = loaded.config;
  std::printf("%s: good: %zu link(s), %zu device(s), %zu joint(s)\n", file.c_str(),
              config.links.size(), config.devices.size(), config.engine.joints.size());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"droverd: the gateway of a field robot"};
  std::string file = "/etc/drover/drover.json";
  std::string checked;
  std::string record;
  bool schema = false;
  bool map_schema = false;
  app.add_option("-c,--config", file, "configuration")->capture_default_str();
  const auto* check_wanted =
      app.add_option("--check", checked, "check a configuration and exit (0 good, 2 not)");
  app.add_option("--record", record,
                 "write all that comes in and goes out to this file, for `drover replay`; when it "
                 "is there, to FILE.1, FILE.2, ...");
  app.add_flag("--schema", schema, "print the configuration's JSON schema and exit");
  app.add_flag("--map-schema", map_schema, "print the JSON schema of a battery's register map");
  app.set_version_flag("--version", DROVER_VERSION);
  app.footer(
      "Examples:\n"
      "  droverd --check /etc/drover/drover.json\n"
      "  droverd --config robot.json\n"
      "  droverd --schema > drover.schema.json\n"
      "  droverd --config robot.json --record run.rec\n"
      "Exit codes: 0 ended as asked, 2 wrong arguments or configuration.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kBadConfiguration;  // 0: --help and --version
  }
  if (schema) {
    std::fputs(drover::config::schema_text().c_str(), stdout);
    return 0;
  }
  if (map_schema) {
    std::fputs(drover::config::register_map_schema_text().c_str(), stdout);
    return 0;
  }
  if (check_wanted->count() > 0) return check(checked);
  try {
    const auto loaded = drover::config::load_file(file);
    if (!report(loaded, file)) return kBadConfiguration;
    return drover::runtime::run_daemon(loaded, file, record);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "droverd: %s\n", error.what());
    return kBadConfiguration;
  }
}
