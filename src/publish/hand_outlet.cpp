#include "publish/hand_outlet.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "json/json_text.h"
#include "json/located_json.h"
#include "publish/line_json.h"
#include "publish/names.h"

namespace drover::publish {
namespace {

/// Apart from the numbers of the other requests of the command line.
constexpr std::uint64_t kHandMark = std::uint64_t{1} << 61U;
/// What the engine has not answered by then it never will.
constexpr std::size_t kMostWaiting = 256;
/// The socket takes fewer at once.
constexpr std::size_t kMostClients = 64;

void number(json::JsonText& out, std::string_view name, double value) {
  out.key(name);
  std::isfinite(value) ? out.number(value) : out.null();
}
/// Nanoseconds of the monotonic clock; null: never.
void instant(json::JsonText& out, Time time) {
  out.key("at_ns");
  time == kNever ? out.null() : out.integer(time.time_since_epoch().count());
}

void write_axes(json::JsonText& out, const Snapshot& seen) {
  out.key("axes").open('[');
  for (const AxisSnapshot& axis : seen.axes) {
    out.open('{');
    instant(out, axis.last_motion);
    number(out, "radps", axis.motion.velocity_radps);
    number(out, "asked_radps", axis.commanded_velocity_radps);
    out.close('}');
  }
  out.close(']');
  if (!seen.base.configured) return;
  out.key("base").open('{');
  instant(out, seen.base.last_motion);
  number(out, "vx_mps", seen.base.measured.vx_mps);
  number(out, "wz_radps", seen.base.measured.wz_radps);
  number(out, "asked_vx_mps", seen.base.commanded.vx_mps);
  number(out, "asked_wz_radps", seen.base.commanded.wz_radps);
  out.close('}');
}

void write_receiver(json::JsonText& out, const GnssSnapshot& gnss) {
  out.key("position").open('{');
  instant(out, gnss.position_time);
  out.key("fixed").boolean(gnss.position.quality == FixQuality::rtk_fixed &&
                           gnss.health == SourceState::fresh);
  number(out, "latitude_deg", gnss.position.latitude_deg);
  number(out, "longitude_deg", gnss.position.longitude_deg);
  number(out, "altitude_m", gnss.position.altitude_msl_m + gnss.position.undulation_m);
  out.close('}').key("heading").open('{');
  instant(out, gnss.heading_time);
  number(out, "deg", gnss.receiver_heading_deg);
  out.close('}').key("speed").open('{');
  instant(out, gnss.velocity_time);
  number(out, "mps", gnss.velocity.speed_mps);
  out.close('}');
}

void write_gyro(json::JsonText& out, const ImuSnapshot& imu) {
  out.key("gyro").open('{');
  instant(out, imu.time);
  number(out, "z_radps", imu.sample.angular_velocity_radps.z);
  out.key("saturated").boolean(imu.sample.saturated);
  number(out, "roll_rad", imu.roll_rad);
  number(out, "pitch_rad", imu.pitch_rad);
  out.close('}');
}

std::optional<double> number_of(const json::Node& request, std::string_view key) {
  const auto* node = request.find(key);
  return node == nullptr ? std::nullopt : node->number();
}

}  // namespace

std::string drive_values_json(const Snapshot& seen) {
  json::JsonText out;
  out.open('{');
  instant(out, seen.time);
  write_axes(out, seen);
  write_receiver(out, seen.gnss);
  write_gyro(out, seen.imu);
  number(out, "vx_mps", seen.pose.vx_mps);
  number(out, "wz_radps", seen.pose.wz_radps);
  // Of the estimate's own frame: for differences.
  number(out, "x_m", seen.pose.x_m);
  number(out, "y_m", seen.pose.y_m);
  number(out, "heading_deg", seen.gnss.pose_heading_deg);
  out.key("owner").text(word(seen.nav.owner));
  out.key("why").text(seen.why.empty() ? std::string_view() : seen.why[0].view());
  return out.close('}').take();
}

HandOutlet::Client& HandOutlet::client_of(ClientId id, Time now) {
  Client& client = clients_[id];
  client.heard = now;
  if (clients_.size() > kMostClients)
    clients_.erase(std::min_element(
        clients_.begin(), clients_.end(),
        [](const auto& a, const auto& b) { return a.second.heard < b.second.heard; }));
  return clients_[id];
}

/// Why not; empty: the engine answers.
std::string HandOutlet::drive(ClientId client, const json::Node& request, Time now, Actions& out) {
  const auto vx_mps = number_of(request, "vx_mps");
  const auto wz_radps = number_of(request, "wz_radps");
  if (!vx_mps || !wz_radps) return "vx_mps or wz_radps is missing";
  Time key = now;
  if (request.find("at_ns") != nullptr) {
    constexpr double kMost_ns = 9e18;
    const double at_ns = number_of(request, "at_ns").value_or(NAN);
    if (!(at_ns >= 0 && at_ns < kMost_ns)) return "at_ns is no instant";
    key = std::min(now, Time{Duration{static_cast<Duration::rep>(at_ns)}});
  }
  const DriveByHand wanted{client, {*vx_mps, *wz_radps}};
  const bool rest = is_zero(wanted.twist);
  Client& who = client_of(client, now);
  // That the key is up is heard however many keys came before; said again it is nothing new.
  if (!(rest && who.moves) && !who.keys.take(now)) return "slow down";
  who.moves = !rest;
  if (waiting_.size() >= kMostWaiting) {
    const RequestId oldest{RequestId::Source::cli, waiting_.begin()->first};
    answer(oldest, false, "the control loop gave no answer", out);
  }
  const RequestId id{RequestId::Source::cli, kHandMark | ++last_number_};
  waiting_[id.number] = client;
  Command command{id, key, {}};
  command.body = wanted;
  out.emplace_back(std::move(command));
  return {};
}

bool HandOutlet::on_line(ClientId client, std::string_view line, Time now, Actions& out) {
  const auto document = json::parse(line, {.max_bytes = 1024, .max_depth = 2, .max_values = 8});
  if (!document) return false;
  const auto cmd = text_member(document->root, "cmd");
  if (cmd == "drive_by_hand") {
    if (const auto why = drive(client, document->root, now, out); !why.empty())
      out.emplace_back(Reply{client, reply_line(false, why)});
    return true;
  }
  if (cmd == "drive_values") {
    if (!client_of(client, now).values.take(now)) {
      out.emplace_back(Reply{client, reply_line(false, "slow down")});
      return true;
    }
    out.emplace_back(
        Reply{client, R"({"ok":true,"values":)" + drive_values_json(seen_(now)) + "}"});
    return true;
  }
  if (cmd != "configuration") return false;
  json::JsonText reply;
  reply.open('{').key("ok").boolean(true).key("configuration").text(texts_.configuration);
  reply.key("register_map").text(texts_.register_map).close('}');
  out.emplace_back(Reply{client, reply.take()});
  return true;
}

void HandOutlet::answer(const RequestId& id, bool ok, std::string_view text, Actions& out) {
  if (id.source != RequestId::Source::cli) return;
  const auto waiting = waiting_.find(id.number);
  if (waiting == waiting_.end()) return;
  out.emplace_back(Reply{waiting->second, reply_line(ok, text)});
  waiting_.erase(waiting);
}

void HandOutlet::on_event(const Event& event, Actions& out) {
  if (const auto* yes = std::get_if<CommandAccepted>(&event.body))
    answer(yes->id, true, yes->note.view(), out);
  else if (const auto* no = std::get_if<CommandRefused>(&event.body))
    answer(no->id, false, no->reason.view(), out);
}

void HandOutlet::on_undelivered(const Command& command, Actions& out) {
  const auto* hand = std::get_if<DriveByHand>(&command.body);
  const auto who = hand == nullptr ? clients_.end() : clients_.find(hand->hand);
  if (who != clients_.end()) who->second.moves = true;  // rest has to be said again, and passes
  answer(command.id, false, "the control loop takes no command now", out);
}

}  // namespace drover::publish
