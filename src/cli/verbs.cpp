#include "cli/verbs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "text/suggestion.h"

namespace drover::cli {

namespace {

struct Example {
  std::string_view verb;
  std::string_view lines;
};

constexpr std::string_view kHeadingFind =
    "  drover heading find            # THE ROBOT DRIVES, up to 3 m straight ahead:\n"
    "                                 # watch that it goes ahead, or: drover stop";

constexpr Example kExamples[] = {
    {"status",
     "  drover status --watch          # again and again\n"
     "  drover status --json | jq .status.why"},
    {"gnss",
     "  drover gnss --watch\n"
     "  drover gnss --file receiver.nmea"},
    {"imu",
     "  drover imu --watch\n"
     "  drover imu --file sensor.bin --option baud=9600"},
    {"bms",
     "  drover bms\n"
     "  drover bms --file registers.txt --map daly_d2.json"},
    {"can",
     "  drover can --watch\n"
     "  drover can --file candump.log  # a table of its ids\n"
     "  drover can --file candump.log --driver odrive --node 3 --option gear_ratio=10"},
    {"gpio",
     "  drover gpio --watch\n"
     "  drover gpio --json"},
    {"replay", "  drover replay run.rec          # recorded by droverd --record run.rec"},
    {"traj",
     "  drover traj list\n"
     "  drover traj show 'row 7'"},
    {"traj list",
     "  drover traj list\n"
     "  drover traj list --json"},
    {"traj show", "  drover traj show 'row 7'"},
    {"traj delete", "  drover traj delete 'row 7'"},
    {"task",
     "  drover task start 'row 7' --id 57\n"
     "  drover task cancel"},
    {"task start",
     "  drover task start 'row 7' --id 57 --speed 0.5   # THE ROBOT DRIVES, to point 57\n"
     "  drover traj show 'row 7'                        # which points it has"},
    {"task cancel", "  drover task cancel             # a controlled stop"},
    {"report",
     "  drover report                  # of the last task\n"
     "  drover report --list\n"
     "  drover report 12 --svg row7.svg --colour quality\n"
     "  drover report --json | jq .report.cross_track"},
    {"scene",
     "  drover scene list\n"
     "  drover scene show box1"},
    {"scene list",
     "  drover scene list\n"
     "  drover scene list --json | jq .objects[].id"},
    {"scene show", "  drover scene show box1"},
    {"scene clear",
     "  drover scene clear            # what others believe to be there is not, then"},
    {"scene accept-loss", "  drover scene accept-loss      # after: drover scene list"},
    {"zone",
     "  drover zone import yard.geojson --keep-in\n"
     "  drover zone list"},
    {"zone import",
     "  drover zone import yard.geojson --keep-in             # shows it, and asks\n"
     "  drover zone import greenhouse.kml --keep-out --name greenhouse --yes"},
    {"zone list",
     "  drover zone list\n"
     "  drover zone list --json"},
    {"zone delete", "  drover zone delete greenhouse"},
    {"zone forget-unreadable", "  drover zone forget-unreadable # after: drover zone list"},
    {"heading", kHeadingFind},
    {"heading find", kHeadingFind},
    {"position", "  drover position accept         # after: a look at the map, and at the robot"},
    {"position accept",
     "  drover position accept         # after: a look at the map, and at the robot"},
    {"learned",
     "  drover learned show\n"
     "  drover learned show --json | jq .learned.values"},
    {"learned show",
     "  drover learned show            # what could be corrected in drover.json\n"
     "  drover learned show --json | jq .learned.values"},
    {"learned forget",
     "  drover learned forget          # after: a wheel, an antenna or a tyre was changed"},
    {"stop",
     "  drover stop                    # zero at once: droverd and the guard are told\n"
     "  drover reset                   # after the cause is gone"},
    {"reset", "  drover reset                   # nothing moves before a new start"},
    {"release",
     "  drover release                 # a person may push the robot\n"
     "  drover release --on-slope      # IT MAY ROLL AWAY"},
    {"hold", "  drover hold                    # ends drover release"},
    {"version", "  drover version"},
};

void add_examples_below(CLI::App& app, const std::string& above) {
  for (auto* verb : app.get_subcommands({})) {
    const std::string name = above + verb->get_name();
    for (const auto& example : kExamples)
      if (example.verb == name) verb->footer("Examples:\n" + std::string(example.lines));
    add_examples_below(*verb, name + " ");
  }
}

}  // namespace

void add_examples(CLI::App& app) {
  add_examples_below(app, "");
}

namespace {

/// Of a hint for "help" nobody must learn to press "hold": a verb that acts on the robot is only
/// named for a slip of one letter.
bool acts_on_the_robot(std::string_view verb) {
  for (const std::string_view one : {"hold", "release", "reset", "start", "find", "delete", "clear",
                                     "accept", "accept-loss", "forget-unreadable", "forget"})
    if (verb == one) return true;
  return false;
}

/// What people call it elsewhere; empty: nothing of that.
std::string_view known_as(std::string_view word) {
  constexpr std::pair<std::string_view, std::string_view> kNames[] = {{"battery", "bms"},
                                                                      {"gps", "gnss"},
                                                                      {"rtk", "gnss"},
                                                                      {"track", "traj"},
                                                                      {"tracks", "traj"},
                                                                      {"trajectory", "traj"},
                                                                      {"fence", "zone"},
                                                                      {"obstacle", "scene"},
                                                                      {"obstacles", "scene"},
                                                                      {"objects", "scene"},
                                                                      {"calibration", "calibrate"}};
  for (const auto& [other, verb] : kNames)
    if (other == word) return verb;
  return "";
}

std::string hint_for(const CLI::App& app, const CLI::App& level, const std::string& word,
                     const std::vector<std::string>& names) {
  // A verb of a verb, written without the first one.
  if (&level == &app) {
    for (const auto* verb : app.get_subcommands({}))
      for (const auto* inner : verb->get_subcommands({}))
        if (inner->get_name() == word)
          return "did you mean \"" + verb->get_name() + " " + word + "\"?";
  }
  if (const auto verb = known_as(word); &level == &app && !verb.empty())
    return "did you mean \"" + std::string(verb) + "\"?";
  const auto best = text::nearest(word, names);
  if (best.empty()) return "";
  const auto [shorter, longer] = std::minmax({word.size(), best.size()});
  const bool slip =
      longer - shorter <= 1 && best.front() == word.front() && best.back() == word.back();
  return acts_on_the_robot(best) && !slip ? "" : text::did_you_mean(word, names);
}

std::vector<std::string> names_of(const std::vector<const CLI::App*>& verbs) {
  std::vector<std::string> names;
  names.reserve(verbs.size());
  for (const auto* verb : verbs) names.push_back(verb->get_name());
  return names;
}

/// "--file" of "--file=x", and "-j" of "-json"; empty of what is no option: "-" and "-3" are
/// values.
std::string option_name(const std::string& word) {
  if (word.starts_with("--")) return word.substr(0, word.find('='));
  const bool is_short =
      word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
  return is_short ? word.substr(0, 2) : "";
}

/// An option of the verb, or of one that stands above it.
const CLI::Option* option_of(const CLI::App& verb, const std::string& name) {
  if (name.empty()) return nullptr;
  for (const auto* level = &verb; level != nullptr; level = level->get_parent())
    if (const auto* option = level->get_option_no_throw(name)) return option;
  return nullptr;
}

bool takes_next_word(const CLI::Option* option, const std::string& word) {
  return option != nullptr && option->get_items_expected_max() > 0 &&
         word.find('=') == std::string::npos;
}

std::string no_option(const CLI::App& verb, const std::string& above, const std::string& word) {
  std::vector<std::string> names;
  for (const auto* level = &verb; level != nullptr; level = level->get_parent())
    for (const auto* option : level->get_options())
      for (const auto& name : option->get_lnames()) names.push_back(name);
  const auto written = word.substr(0, word.find('='));
  const auto best = text::nearest(written.substr(written.find_first_not_of('-')), names);
  const auto of = above.empty() ? "" : " of \"" + above.substr(0, above.size() - 1) + '"';
  return "no option \"" + written + '"' + of +
         (best.empty() ? "; see: drover " + above + "--help"
                       : "; did you mean \"--" + best + "\"?");
}

}  // namespace

std::string unknown_option(const CLI::App& app, std::span<const char* const> arguments) {
  const CLI::App* level = &app;
  std::string above;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string word = arguments[i];
    if (word == "--") return {};  // what follows are values
    const auto name = option_name(word);
    const auto* option = option_of(*level, name);
    if (takes_next_word(option, word)) ++i;
    if (!name.empty() && option == nullptr) return no_option(*level, above, word);
    const auto verbs = level->get_subcommands({});
    if (!name.empty() || verbs.empty()) continue;
    const auto found = std::find_if(verbs.begin(), verbs.end(), [&word](const CLI::App* verb) {
      return verb->get_name() == word;
    });
    if (found == verbs.end()) return {};
    above += word + " ";
    level = *found;
  }
  return {};
}

std::string unknown_verb(const CLI::App& app, std::span<const char* const> arguments) {
  const CLI::App* level = &app;
  std::string above;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string word = arguments[i];
    if (takes_next_word(option_of(*level, option_name(word)), word)) ++i;  // its value is no verb
    if (word.empty() || word.front() == '-') continue;
    const auto verbs = level->get_subcommands({});
    if (verbs.empty()) return {};
    const auto names = names_of(verbs);
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      const auto hint = hint_for(app, *level, word, names);
      std::string all;
      for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
      return "no verb \"" + above + word + "\"; " + (hint.empty() ? "there are " + all : hint);
    }
    above += word + " ";
    level = verbs[static_cast<std::size_t>(found - names.begin())];
  }
  return {};
}

std::string incomplete(const CLI::App& app, std::span<const char* const> arguments,
                       const std::string& why) {
  const CLI::App* level = &app;
  std::string verb;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string word = arguments[i];
    if (takes_next_word(option_of(*level, option_name(word)), word)) ++i;
    const auto verbs = level->get_subcommands({});
    const auto inner = std::find_if(verbs.begin(), verbs.end(), [&word](const CLI::App* one) {
      return one->get_name() == word;
    });
    if (inner == verbs.end()) continue;
    verb += (verb.empty() ? "" : " ") + word;
    level = *inner;
  }
  if (verb.empty()) return why + "; see: drover --help";
  std::string all;
  for (const auto& name : names_of(level->get_subcommands({})))
    all += (all.empty() ? "" : ", ") + name;
  if (level->get_require_subcommand_min() > 0) return '"' + verb + "\" wants one of: " + all;
  return '"' + verb + "\": " + why + "; see: drover " + verb + " --help";
}

}  // namespace drover::cli
