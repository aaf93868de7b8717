#include "gateway/recording/text.h"

#include "gateway/recording/input_codec.h"

namespace drover::gateway {

namespace {

constexpr int size_of(std::string_view text) {
  return static_cast<int>(text.size());
}

/// A word, who asked, and a reason.
Line answer(const char* word, const RequestId& id, std::string_view reason) {
  Line line;
  line.format("%s %d/%llu: %.*s", word, static_cast<int>(id.source),
              static_cast<unsigned long long>(id.number), size_of(reason), reason.data());
  return line;
}

Line body_text(const std::monostate&) {
  return "nothing";
}
Line body_text(const CommandAccepted& event) {
  return answer("accepted", event.id, event.note);
}
Line body_text(const CommandRefused& event) {
  return answer("refused", event.id, event.reason);
}
Line body_text(const NavigationStarted& event) {
  return answer("navigation started", event.id, "");
}
Line body_text(const NavigationNotStarted& event) {
  return answer("navigation not started", event.id, event.reason);
}
Line body_text(const TaskEnded& event) {
  constexpr const char* kHow[] = {"task succeeded", "task cancelled", "task failed"};
  return answer(kHow[static_cast<std::size_t>(event.how)], event.id, event.reason);
}
Line body_text(const OriginProposed& event) {
  Line place;
  place.format("%.17g %.17g %.17g", event.origin.latitude_deg, event.origin.longitude_deg,
               event.origin.altitude_m);
  return answer("origin proposed", event.id, place);
}
/// Its number: an address is another one in each run.
Line body_text(const PathReleased& event) {
  Line line;
  line.format("path %llu released",
              event.path == nullptr ? 0ULL : static_cast<unsigned long long>(event.path->number));
  return line;
}
Line body_text(const Notice& event) {
  const auto text = event.text.view();
  Line line;
  line.format("notice %d: %.*s", static_cast<int>(event.level), size_of(text), text.data());
  return line;
}

std::string number(std::uint64_t value) {
  return std::to_string(value);
}

std::string link_name(const Wiring& wiring, LinkId link) {
  return link < wiring.links.size() ? std::string(wiring.links[link].name) : "link " + number(link);
}
std::string slot_name(const Wiring& wiring, SlotId slot) {
  return slot < wiring.slots.size() ? std::string(wiring.slots[slot].name) : "slot " + number(slot);
}

std::string words(const FrameHeard& heard, const Wiring& wiring) {
  return "frame on " + link_name(wiring, heard.bus) + ": " + std::string(text_of(heard.frame)) +
         (heard.frame.error ? " (error frame)" : "");
}
std::string words(const BytesHeard& heard, const Wiring& wiring) {
  return "bytes on " + link_name(wiring, heard.link) + ": " + text_of(heard.bytes);
}
std::string words(const LevelsRead& read, const Wiring& wiring) {
  std::string text = "levels of " + link_name(wiring, read.link) + ":";
  for (const bool level : read.levels) text += level ? " 1" : " 0";
  return text;
}
std::string words(const RegistersRead& read, const Wiring& wiring) {
  std::string text =
      "registers of " + slot_name(wiring, read.slot) + ", block " + number(read.block) + ":";
  for (const auto word : read.words) text += " " + number(word);
  return text;
}
std::string words(const RegistersFailed& failed, const Wiring& wiring) {
  return "no registers of " + slot_name(wiring, failed.slot) + ", block " + number(failed.block) +
         ": failure " + number(static_cast<std::uint64_t>(failed.failure)) + ", exception " +
         std::to_string(failed.exception);
}
std::string words(const LinkUp& up, const Wiring& wiring) {
  return link_name(wiring, up.link) + " up";
}
std::string words(const LinkLost& lost, const Wiring& wiring) {
  return link_name(wiring, lost.link) + " lost: " + std::string(lost.why);
}
std::string words(const FramesSent& counts, const Wiring& wiring) {
  return link_name(wiring, counts.bus) + " took " + number(counts.sent) +
         " frames so far, refused " + number(counts.refused);
}
std::string words(const Tick& tick, const Wiring&) {
  return std::string("tick") + (tick.guard_alive ? ", guard alive" : ", no guard") +
         (tick.guard_has_bus ? ", guard has the bus" : "") +
         (tick.guard_latched ? ", stopped at the guard" : "") +
         (tick.guard_refuses_set ? ", the guard keeps another stop set" : "") +
         (tick.guard_has_all ? ", the guard has all" : "");
}
std::string words(const ProgramTrouble& trouble, const Wiring&) {
  return "trouble of the daemon: " + std::string(trouble.why);
}
std::string words(const Suspended& slept, const Wiring&) {
  return "the computer slept for " + std::to_string(slept.lasted_s) + " s";
}
std::string words(const HeldUp& held_up, const Wiring&) {
  return "droverd stood still for " + std::to_string(held_up.lasted_s) + " s";
}
std::string words(const Recalled& recalled, const Wiring&) {
  const auto& [stop, stop_at_robot, power_cut, holding, released, task, proved, joints_wait,
               at_rest, ran_away, place] = recalled.remembered;
  const std::string where =
      place.known ? " at " + std::to_string(place.x_m) + " " + std::to_string(place.y_m) : "";
  return std::string("recalled:") + (at_rest ? " at rest" : "") + where + (holding ? " held" : "") +
         (released ? " released" : "") + (power_cut ? " without power" : "") +
         (ran_away ? " run away" : "") + (task ? " with a task" : "") +
         (proved ? " with proved mechanics" : "") +
         (joints_wait.empty() ? "" : " joint commands wait: " + std::string(joints_wait) + ",") +
         (stop_at_robot ? " stopped at the robot: " : " stopped: ") + std::string(stop);
}
std::string words(const LearnedRecalled& recalled, const Wiring&) {
  std::string text = "learned of the robot:";
  each_learned(recalled.learned, [&text](const char* name, const LearnedValue& value) {
    if (!value.known()) return;
    text += " " + std::string(name) + " " + std::to_string(value.value) + " +- " +
            std::to_string(value.sigma);
  });
  return text;
}
std::string words(const OutputsUp& up, const Wiring&) {
  return std::string("outputs up, relay ") + (up.relay_closed ? "closed" : "open");
}
/// How long it is free, and in brackets by the margin alone.
std::string way(double is, double bare, const char* unit) {
  return std::to_string(is) + " (" + std::to_string(bare) + ") " + unit;
}
std::string words(const ClearanceFound& found, const Wiring&) {
  const Clearance& clearance = found.clearance;
  const BareWays& bare = clearance.bare;
  const std::string time =
      clearance.t == kNever ? "no time" : std::to_string(to_s(clearance.t)) + " s";
  std::string text = "surroundings " + number(clearance.scene) + ", track " +
                     number(clearance.path) + ", of " + time + ", at " +
                     std::to_string(clearance.twist.vx_mps) + " m/s and " +
                     std::to_string(clearance.twist.wz_radps) + " rad/s: free along it " +
                     way(clearance.along_m, bare.along_m, "m") + ", ahead " +
                     way(clearance.ahead_m, bare.ahead_m, "m") + ", back " +
                     way(clearance.back_m, bare.back_m, "m") + ", left " +
                     way(clearance.left_rad, bare.left_rad, "rad") + ", right " +
                     way(clearance.right_rad, bare.right_rad, "rad");
  if (bare.aside_left_m > 0 || bare.aside_right_m > 0)
    text += ", to the side: left " + way(clearance.aside_left_m, bare.aside_left_m, "m") +
            ", right " + way(clearance.aside_right_m, bare.aside_right_m, "m");
  if (!clearance.first.empty()) text += ", " + std::string(clearance.first);
  if (!clearance.turn.empty()) text += ", turning " + std::string(clearance.turn);
  if (!clearance.unknown.empty()) text += ", not known: " + std::string(clearance.unknown);
  if (!clearance.broken.empty()) text += ", broken: " + std::string(clearance.broken);
  return text;
}
std::string words(const CommandGiven& given, const Wiring&) {
  constexpr const char* kBodies[] = {"nothing",
                                     "start of a task",
                                     "cancel",
                                     "stop",
                                     "reset",
                                     "proposal of an origin",
                                     "an origin",
                                     "joint targets",
                                     "joint targets refused",
                                     "heading search",
                                     "release",
                                     "hold",
                                     "a person accepts the position",
                                     "a person has what was learned forgotten",
                                     "a key that drives",
                                     "a twist to follow",
                                     "a twist refused"};
  static_assert(std::size(kBodies) == std::variant_size_v<decltype(Command::body)>);
  const auto& command = given.command;
  std::string text = "command " + number(static_cast<std::uint64_t>(command.id.source)) + "/" +
                     number(command.id.number) + ": " + kBodies[command.body.index()];
  if (const auto* start = std::get_if<StartTask>(&command.body))
    text += " on path " + number(start->path == nullptr ? 0 : start->path->number) + " to point " +
            number(start->target);
  return text;
}

}  // namespace

Line text_of(const Event& event) {
  const Line body = std::visit([](const auto& it) { return body_text(it); }, event.body);
  const auto text = body.view();
  Line line;
  line.format("at %.9f s: %.*s", to_s(event.time), size_of(text), text.data());
  return line;
}

Line text_of(const CanFrame& frame) {
  Line line;
  char data[2 * 64 + 1] = {};
  for (std::size_t i = 0; i < frame.len; ++i)
    std::snprintf(data + 2 * i, 3, "%02X", static_cast<unsigned>(frame.data[i]));
  line.format(frame.extended ? "%08X#%s%s%s" : "%03X#%s%s%s", frame.id, frame.fd ? "#0" : "",
              frame.remote ? "R" : "", data);
  return line;
}

std::string text_of(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kMostShown = 96;
  std::string text;
  for (const auto byte : bytes.first(std::min(bytes.size(), kMostShown))) {
    char pair[3] = {};
    std::snprintf(pair, sizeof pair, "%02X", static_cast<unsigned>(byte));
    text += pair;
  }
  return text + (bytes.size() > kMostShown ? "..." : "");
}

std::string text_of(const Input& input, const Wiring& wiring) {
  char time[40] = {};
  std::snprintf(time, sizeof time, "at %.9f s: ", to_s(input.time));
  return time + std::visit([&](const auto& body) { return words(body, wiring); }, input.body);
}

}  // namespace drover::gateway
