#include "publish/scene_requests.h"

#include <algorithm>
#include <utility>

#include "publish/line_json.h"
#include "publish/scene_list.h"
#include "scene/zone/zone_checks.h"
#include "scene/zone/zone_text.h"

namespace drover::publish {
namespace {

constexpr std::size_t kMostLoggedBytes = 200;

/// Without what has this name; nothing: no zone had it.
std::optional<scene::Zone> take_out(std::vector<scene::Zone>& zones, std::string_view name) {
  const auto found = std::ranges::find(zones, name, &scene::Zone::name);
  if (found == zones.end()) return std::nullopt;
  auto taken = std::move(*found);
  zones.erase(found);
  return taken;
}

RequestId storage_id(std::uint64_t number) {
  return {RequestId::Source::internal, number};
}

}  // namespace

SceneRequests::SceneRequests(bool configured, JobNumbers& numbers, SceneSaver& saver,
                             std::function<RobotNow(Time)> robot)
    : configured_(configured),
      numbers_(numbers),
      saver_(saver),
      robot_(std::move(robot)),
      zones_(std::make_shared<const std::vector<scene::Zone>>()) {}

std::optional<SceneRequests::What> SceneRequests::what_of(std::string_view cmd) {
  constexpr std::pair<std::string_view, What> kRequests[] = {
      {"scene_list", What::list},    {"scene_show", What::show},
      {"scene_clear", What::clear},  {"scene_accept_loss", What::accept},
      {"zone_list", What::zones},    {"zone_import", What::import},
      {"zone_delete", What::remove}, {"zone_forget_unreadable", What::forget},
  };
  for (const auto& [name, what] : kRequests)
    if (cmd == name) return what;
  return std::nullopt;
}

bool SceneRequests::on_line(ClientId client, std::string_view line, Time now, Actions& out) {
  std::string cmd = "zone_import";
  std::string name;
  if (!line.starts_with(kLongLine)) {
    const auto document =
        json::parse(line, {.max_bytes = 64 * 1024, .max_depth = 4, .max_values = 64});
    if (!document) return false;
    cmd = text_member(document->root, "cmd");
    name = text_member(document->root, "name");
  }
  const auto what = what_of(cmd);
  if (!what) return false;
  if (const auto why = refusal(*what, now); !why.empty()) {
    out.emplace_back(Reply{client, reply_line(false, why)});
  } else {
    ask({*what, client, std::move(cmd), std::move(name), 0}, line, now, out);
  }
  return true;
}

/// Why it cannot be asked now; empty: it can.
std::string SceneRequests::refusal(What what, Time now) {
  if (!configured_) return std::string(kNoScene);
  if (!restored_) return "what is stored is being read, try again";
  const bool changes_zones = what == What::import || what == What::remove || what == What::forget;
  if (changes_zones && change_) return "another change of the zones is under way, try again";
  const bool takes_away =
      what == What::clear || what == What::accept || what == What::remove || what == What::forget;
  if (takes_away)
    if (const auto busy = robot_(now).busy; !busy.empty()) return std::string(busy);
  if (what == What::accept && scene_problem_.empty()) return "nothing of the scene is lost";
  if (what == What::forget && of_file_.empty())
    return "the file of the zones can be read: delete zones one by one";
  return {};
}

void SceneRequests::ask(Asked asked, std::string_view line, Time now, Actions& out) {
  const auto number = numbers_.next();
  const Asked& request = asked_[number] = std::move(asked);
  const std::string& name = request.name;
  switch (request.what) {
    case What::list: append_job<SceneJob>(out, number, ListScene{}); return;
    case What::show: append_job<SceneJob>(out, number, ShowScene{name}); return;
    case What::clear: append_job<SceneJob>(out, number, ClearScene{}); return;
    case What::accept:
      out.emplace_back(store::StorageJob{storage_id(number), saver_.give_up_lost()});
      return;
    case What::zones:
      append_job<SceneTextJob>(
          out, number,
          ListZones{zones_, unreadable_, zones_problem(of_file_, unreadable_), robot_(now).place});
      return;
    case What::import:
      append_job<SceneTextJob>(out, number, ImportZone{robot_(now).place}).payload = line;
      return;
    case What::remove: {
      ZoneChange change{number, nullptr, unreadable_, of_file_, {}};
      auto zones = *zones_;
      change.taken = take_out(zones, name);
      change.zones = std::make_shared<const std::vector<scene::Zone>>(std::move(zones));
      std::erase_if(change.unreadable, [&](const auto& zone) { return zone.name == name; });
      change.reply = reply_line(true, "the zone \"" + name + "\" is deleted");
      begin(std::move(change), store::DeleteZone{name}, out);
      return;
    }
    case What::forget:
      // Until now nothing was free, so that nobody drives when it acts.
      begin({number,
             std::make_shared<const std::vector<scene::Zone>>(),
             {},
             {},
             reply_line(true, "there is no zone; a file that was there is kept aside")},
            store::ForgetUnreadableZones{}, out);
      return;
  }
}

void SceneRequests::begin(ZoneChange change, decltype(store::StorageJob::what) job, Actions& out) {
  out.emplace_back(store::StorageJob{storage_id(change.number), std::move(job)});
  change_ = std::move(change);
}

void SceneRequests::on_restored(SceneRestored restored) {
  restored_ = true;
  scene_problem_ = std::move(restored.problem);
  zones_ = std::move(restored.zones);
  unreadable_ = std::move(restored.unreadable);
  of_file_ = std::move(restored.zones_problem);
}

std::string SceneRequests::problem() const {
  const auto zones = zones_problem(of_file_, unreadable_);
  return scene_problem_.empty() ? zones : scene_problem_;
}

bool SceneRequests::on_reply(SceneReply& reply, Time now, Actions& out) {
  const auto asked = asked_.find(reply.number);
  if (asked == asked_.end()) return false;
  if (const auto* list = std::get_if<SceneListed>(&reply.what)) {
    answer(reply.number, scene_list_line(*list, saver_, robot_(now).place.in_map, scene_problem_),
           out);
  } else if (auto* shown = std::get_if<SceneShown>(&reply.what)) {
    if (!shown->object && !shown->constraints) {
      refuse(reply.number, "there is nothing named \"" + asked->second.name + "\"", out);
    } else {
      append_job<SceneTextJob>(out, reply.number, WriteShown{std::move(*shown)});
    }
  } else if (const auto* refused = std::get_if<SceneRefused>(&reply.what)) {
    if (change_ && change_->number == reply.number) {
      on_zones_set(false, refused->why, now, out);
    } else {
      refuse(reply.number, refused->why, out);
    }
  } else if (asked->second.what == What::clear) {
    asked->second.save = saver_.note_cleared();
  } else if (asked->second.what == What::accept) {
    scene_problem_.clear();
    answer(reply.number, reply_line(true, "the scene is what can be read of it"), out);
  } else if (change_ && change_->number == reply.number) {
    on_zones_set(true, {}, now, out);
  }
  return true;
}

/// They act, or they do not: a task began while the disk was busy. Then what was taken away is
/// stored again, so that it is there after a restart, too.
void SceneRequests::on_zones_set(bool done, std::string_view why_not, Time now, Actions& out) {
  if (!done) {
    change_->refused = why_not;
    const scene::Zone& taken = *change_->taken;
    out.emplace_back(store::StorageJob{
        storage_id(change_->number),
        store::SaveZone{taken.name, scene::zone_text(taken), robot_(now).wall_s}});
    return;
  }
  zones_ = std::move(change_->zones);
  unreadable_ = std::move(change_->unreadable);
  of_file_ = std::move(change_->of_file);
  const auto number = change_->number;
  std::string line = std::move(change_->reply);
  change_.reset();
  answer(number, std::move(line), out);
}

void SceneRequests::end_putting_back(const store::StorageReply& reply, Actions& out) {
  std::string why(change_->refused);
  if (!reply.ok)
    why += "; the zone \"" + change_->taken->name +
           "\" counts, but would be lost at a restart: " + reply.reason;
  change_.reset();
  refuse(reply.id.number, why, out);
}

bool SceneRequests::on_text(SceneTextReply& reply, Time now, Actions& out) {
  const auto number = reply.job.number;
  if (!asked_.contains(number)) return false;
  if (auto* line = std::get_if<std::string>(&*reply.result)) {
    answer(number, std::move(*line), out);
  } else if (auto* zone = std::get_if<Result<ZoneRead, std::string>>(&*reply.result)) {
    zone->ok() ? import(number, std::move(zone->value()), now, out)
               : refuse(number, zone->error(), out);
  }
  return true;
}

void SceneRequests::import(std::uint64_t number, ZoneRead read, Time now, Actions& out) {
  if (change_) return refuse(number, "another change of the zones is under way, try again", out);
  if (const auto no_room = scene::check_room(*zones_, read.zone))
    return refuse(number, no_room->why, out);
  ZoneChange change{number, nullptr, unreadable_, of_file_, {}};
  const std::string name = read.zone.name;
  auto zones = *zones_;
  change.taken = take_out(zones, name);
  const auto gone =
      std::erase_if(change.unreadable, [&](const auto& zone) { return zone.name == name; });
  const bool replaced = change.taken || gone > 0;
  if (const auto busy = robot_(now).busy; replaced && !busy.empty())
    return refuse(number, "a zone of this name is there: " + std::string(busy), out);
  zones.push_back(std::move(read.zone));
  change.zones = std::make_shared<const std::vector<scene::Zone>>(std::move(zones));
  change.reply = R"({"ok":true,"zone":)" + read.shown + R"(,"replaced":)" +
                 (replaced ? "true" : "false") + R"(,"notes":)";
  json::JsonText notes;
  notes.open('[');
  for (const std::string& note : read.notes) notes.text(note);
  change.reply += notes.close(']').take() + "}";
  begin(std::move(change), store::SaveZone{name, std::move(read.text), robot_(now).wall_s}, out);
}

bool SceneRequests::on_stored(const store::StorageReply& reply, Actions& out) {
  const auto number = reply.id.number;
  const auto asked = asked_.find(number);
  if (asked == asked_.end()) return false;
  if (asked->second.what == What::accept) {
    saver_.on_given_up(reply.ok);
    if (!reply.ok) return refuse(number, reply.reason, out), true;
    append_job<SceneJob>(out, number, AcceptSceneLoss{});
    return true;
  }
  if (!change_->refused.empty()) return end_putting_back(reply, out), true;
  if (!reply.ok) {
    change_.reset();
    return refuse(number, reply.reason, out), true;
  }
  set_zones(out);
  return true;
}

/// From here on they act, if nobody moves the robot by then.
void SceneRequests::set_zones(Actions& out) {
  append_job<SceneJob>(
      out, change_->number,
      SetZones{change_->zones, zones_problem(change_->of_file, change_->unreadable),
               change_->taken.has_value()});
}

void SceneRequests::on_saved(std::uint64_t save, std::string_view failure, Actions& out) {
  for (auto it = asked_.begin(); it != asked_.end();) {
    const auto [number, asked] = *it++;
    if (asked.save == 0 || asked.save > save) continue;
    if (failure.empty()) {
      answer(number, reply_line(true, "objects and constraints are cleared; zones stay"), out);
    } else {
      refuse(number, "cleared, but it would be back after a restart: " + std::string(failure), out);
    }
  }
}

bool SceneRequests::on_unparsed(std::uint64_t number, Actions& out) {
  if (!asked_.contains(number)) return false;
  refuse(number, "too much is being read already, try again", out);
  return true;
}

bool SceneRequests::on_unasked(const SceneJob& job, Actions& out) {
  if (std::holds_alternative<SetZones>(job.what)) {
    to_be_set_ = true;  // they are stored: it must not end here
    return true;
  }
  const auto asked = asked_.find(job.number);
  if (asked == asked_.end()) return false;
  if (asked->second.what == What::accept) {
    refuse(job.number, "it is stored, and comes into force at the next start: the scene is behind",
           out);
  } else {
    refuse(job.number, "the scene is behind with earlier messages, try again", out);
  }
  return true;
}

void SceneRequests::on_time(Actions& out) {
  if (std::exchange(to_be_set_, false)) set_zones(out);
}

void SceneRequests::answer(std::uint64_t number, std::string line, Actions& out) {
  const auto asked = asked_.find(number);
  const What what = asked->second.what;
  const bool question = what == What::list || what == What::show || what == What::zones;
  if (!question)
    out.emplace_back(LogLine{Notice::Level::info, asked->second.cmd + " " + asked->second.name +
                                                      ": " + json::shown(line, kMostLoggedBytes)});
  out.emplace_back(Reply{asked->second.client, std::move(line)});
  asked_.erase(asked);
}

void SceneRequests::refuse(std::uint64_t number, std::string_view why, Actions& out) {
  answer(number, reply_line(false, why), out);
}

}  // namespace drover::publish
