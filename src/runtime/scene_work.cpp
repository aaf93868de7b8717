#include "runtime/scene_work.h"

#include <algorithm>
#include <utility>

#include "publish/not_while.h"
#include "publish/scene/stored_text.h"
#include "scene/zone/zone_text.h"

namespace drover::runtime {
namespace {

using publish::SceneContent;

/// Of those that were looked along and are not driven: a start that waits for its turn is younger.
constexpr std::size_t kMostPaths = 8;
/// Of one look along a track, which begins anew in a turn after a change of the scene: two seconds
/// of changes in every turn.
constexpr int kMostBeginnings = 80;
/// Until the viewpoint tells of a task whose track was found free.
constexpr Duration kBeginsWithin = std::chrono::milliseconds(500);
/// As many as the ring takes.
constexpr std::size_t kMostUnsent = 256;

std::string words(const scene::Refusal& refusal) {
  return refusal.path.empty() ? refusal.why : refusal.path + " " + refusal.why;
}

publish::SceneRow row_of(const scene::Object& object) {
  publish::SceneRow row{store::kObjectKind, object.id};
  row.shapes = object.primitives.size() + object.meshes.size() + object.planes.size();
  for (const auto& mesh : object.meshes) row.triangles += mesh.shape.triangles.size();
  const auto place = [&row](const auto& shapes) {
    if (row.in_map || shapes.empty()) return;
    const auto& at = shapes.front().in_map.position_m;
    row.in_map = scene::Point2{at.x, at.y};
  };
  place(object.primitives);
  place(object.meshes);
  place(object.planes);
  return row;
}

publish::SceneRow row_of(const scene::ConstraintSet& set) {
  publish::SceneRow row{store::kConstraintKind, set.message.name};
  row.joint = set.message.joint_constraints.size();
  row.position = set.message.position_constraints.size();
  row.orientation = set.message.orientation_constraints.size();
  row.visibility = set.message.visibility_constraints.size();
  return row;
}

}  // namespace

SceneWork::SceneWork(scene::KeeperSettings settings, SceneExchange& exchange,
                     std::shared_ptr<const store::StoredScene> stored)
    : exchange_(exchange),
      stored_(std::move(stored)),
      keeper_(std::move(settings)),
      restoring_(Restoring{}) {}

void SceneWork::work(const scene::TimeLeft& time_left) {
  while (unsent_.size() < kMostUnsent && time_left())
    if (!restore_step() && !job_step()) return;
}

void SceneWork::check(const scene::TimeLeft& time_left) {
  while (!restoring_ && !checks_.empty() && unsent_.size() < kMostUnsent)
    if (!check_first(time_left) || !time_left()) return;
}

void SceneWork::send_replies() {
  const auto before = unsent_.size();
  while (!unsent_.empty() && exchange_.replies.push(std::move(unsent_.front())))
    unsent_.pop_front();
  if (unsent_.size() < before) exchange_.replies_ready.notify();
}

void SceneWork::see(const Viewpoint& from) {
  keeper_.see(from);
  driven_ = from.way.path;
  owner_ = from.owner;
  seen_ = from.t;
}

/// Why nothing that may be in its way can be taken out of it; empty: it can.
std::string_view SceneWork::not_now() const {
  const auto busy = publish::not_while(owner_, driven_ != 0);
  const bool begins = !checks_.empty() || (checked_ != kNever && seen_ - checked_ < kBeginsWithin);
  return busy.empty() && begins ? publish::kNotWhileItBegins : busy;
}

Clearance SceneWork::look() const {
  return keeper_.look(path(driven_));
}

/// Zones first: what is around is not known before both are there.
bool SceneWork::restore_step() {
  if (!restoring_) return false;
  if (restoring_->zones < stored_->zones.size()) {
    restore_zone(stored_->zones[restoring_->zones++]);
  } else if (restoring_->texts < stored_->texts.size()) {
    restore_text(stored_->texts[restoring_->texts++]);
  } else {
    end_restoring();
  }
  return true;
}

void SceneWork::restore_zone(const store::NamedText& text) {
  auto zone = scene::read_zone_text(text.text);
  if (zone.ok() && zone->name == text.name) {
    restoring_->good_zones.push_back(std::move(zone.value()));
  } else {
    restoring_->reply.unreadable.push_back(
        {text.name, zone.ok() ? "it has another name inside" : words(zone.error())});
  }
}

void SceneWork::restore_text(const store::NamedText& text) {
  const bool is_object = text.kind == store::kObjectKind;
  const auto problem = is_object ? restore_object(text) : restore_set(text.text);
  if (!problem) return;
  if (is_object) lost_objects_.insert(text.name);
  auto& reply = restoring_->reply;
  reply.lost.push_back({text.kind, text.name});
  if (reply.problem.empty())
    reply.problem = std::string(is_object ? "the stored object \"" : "the stored constraints \"") +
                    text.name + "\" cannot be read: " + words(*problem);
}

/// All of it or nothing: half an object would look like a whole one once the loss is accepted.
std::optional<scene::Refusal> SceneWork::restore_object(const store::NamedText& text) {
  const auto stored = publish::read_stored_object(text.text);
  if (!stored.ok()) return stored.error();
  for (const auto& message : stored->messages)
    if (message.id != text.name) return scene::Refusal{"", "it has another name inside"};
  for (const auto& message : stored->messages) {
    const auto applied = keeper_.restore(message, stored->origin, stored->place_sigma_m);
    if (applied.ok()) continue;
    keeper_.forget(text.name);
    return applied.error();
  }
  return std::nullopt;
}

std::optional<scene::Refusal> SceneWork::restore_set(const std::string& text) {
  const auto stored = publish::read_stored_set(text);
  if (!stored.ok()) return stored.error();
  const auto applied = keeper_.restore(stored->message, stored->origin);
  return applied.ok() ? std::nullopt : std::optional<scene::Refusal>(applied.error());
}

void SceneWork::end_restoring() {
  auto& reply = restoring_->reply;
  if (!stored_->problem.empty()) reply.problem = stored_->problem;
  reply.zones_problem = stored_->zones_problem;
  reply.zones = std::make_shared<const std::vector<scene::Zone>>(std::move(restoring_->good_zones));
  keeper_.set_zones(*reply.zones, publish::zones_problem(reply.zones_problem, reply.unreadable));
  keeper_.set_scene_problem(reply.problem);
  this->reply(0, std::move(reply));
  restoring_.reset();
  stored_.reset();
}

/// One message, or one job that is short.
bool SceneWork::job_step() {
  if (batch_) {
    apply_next();
    return true;
  }
  publish::SceneJob job;
  if (!exchange_.jobs.pop(job)) return false;
  take(std::move(job));
  return true;
}

void SceneWork::take(publish::SceneJob job) {
  const auto number = job.number;
  if (std::holds_alternative<publish::ApplyMessages>(job.what)) {
    batch_.emplace(Batch{std::move(job), 0, {}});
  } else if (auto* zones = std::get_if<publish::SetZones>(&job.what)) {
    if (zones->takes_away && !not_now().empty())
      return reply(number, publish::SceneRefused{not_now()});
    keeper_.set_zones(*zones->zones, zones->problem);
    reply(number, publish::SceneDone{});
  } else if (std::holds_alternative<publish::ClearScene>(job.what)) {
    if (!not_now().empty()) return reply(number, publish::SceneRefused{not_now()});
    keeper_.clear();
    (void)keeper_.take_changed_objects();  // who asked for it knows that all are gone
    (void)keeper_.take_changed_sets();
    reply(number, publish::SceneDone{});
  } else if (std::holds_alternative<publish::AcceptSceneLoss>(job.what)) {
    // Until now nothing was free, so that nobody drives.
    keeper_.set_scene_problem("");
    lost_objects_.clear();
    reply(number, publish::SceneDone{});
  } else if (std::holds_alternative<publish::ListScene>(job.what)) {
    reply(number, list());
  } else if (const auto* show = std::get_if<publish::ShowScene>(&job.what)) {
    reply(number, publish::SceneShown{object(show->name), constraints(show->name)});
  } else if (auto* check = std::get_if<publish::CheckTrack>(&job.what)) {
    keep_path(check->path);
    checks_.push_back({number, std::move(*check), nullptr});
  }
}

void SceneWork::apply_next() {
  const auto& all = std::get<publish::ApplyMessages>(batch_->job.what);
  if (batch_->next == all.messages.size()) return end_batch();
  const auto& value = all.messages[batch_->next++];
  const auto applied =
      std::visit([&](const auto& message) { return apply(message, all.arrived); }, value);
  batch_->applied.results.push_back(applied.ok()
                                        ? publish::MessageApplied{std::nullopt, applied->notes}
                                        : publish::MessageApplied{applied.error(), {}});
}

Result<scene::Applied, scene::Refusal> SceneWork::apply(const scene::CollisionObject& message,
                                                        const scene::Arrived& arrived) {
  using Object = scene::CollisionObject;
  if (message.operation == Object::APPEND && lost_objects_.contains(message.id))
    return scene::Refusal{"id",
                          "is of an object whose stored shapes cannot be read: ADD all of it, or "
                          "give them up (drover scene accept-loss)"};
  auto applied = keeper_.apply(message, arrived);
  if (applied.ok() && message.operation == Object::ADD) lost_objects_.erase(message.id);
  return applied;
}

Result<scene::Applied, scene::Refusal> SceneWork::apply(const scene::Constraints& message,
                                                        const scene::Arrived& arrived) {
  return keeper_.apply(message, arrived);
}

/// What is to be stored is what came of all of it.
void SceneWork::end_batch() {
  auto& changes = batch_->applied.changes;
  for (const auto& name : keeper_.take_changed_objects())
    changes.push_back({store::kObjectKind, name, object(name)});
  for (const auto& name : keeper_.take_changed_sets())
    changes.push_back({store::kConstraintKind, name, constraints(name)});
  reply(batch_->job.number, std::move(batch_->applied));
  batch_.reset();
}

/// The first one, anew when something has changed meanwhile; false: it needs more time.
bool SceneWork::check_first(const scene::TimeLeft& time_left) {
  Check& check = checks_.front();
  if (!check.track || check.track->number() != keeper_.number()) {
    check.track = keeper_.check(*check.what.path, check.what.target);
    ++check.begun;
  }
  std::optional<scene::TrackOffence> offence;
  if (check.track->advance(time_left)) {
    offence = check.track->offence();
  } else if (check.begun > kMostBeginnings) {  // or no other start would ever be looked at
    offence = {0, 0, "what is around changes faster than the track can be looked along, try again"};
  } else {
    return false;
  }
  if (!offence) checked_ = seen_;
  reply(check.number, publish::TrackChecked{offence});
  checks_.pop_front();
  return true;
}

void SceneWork::reply(std::uint64_t number, decltype(publish::SceneReply::what) what) {
  unsent_.push_back({number, std::move(what)});
}

publish::SceneListed SceneWork::list() const {
  publish::SceneListed listed;
  for (const auto& object : keeper_.world().objects()) {
    listed.rows.push_back(row_of(object));
    listed.rows.back().nearest = keeper_.nearest_of(object.id);
  }
  for (const auto& set : keeper_.world().constraints()) listed.rows.push_back(row_of(set));
  return listed;
}

std::shared_ptr<const SceneContent> SceneWork::object(const std::string& name) const {
  auto stored = keeper_.stored_object(name);
  return stored ? std::make_shared<const SceneContent>(std::move(*stored)) : nullptr;
}

std::shared_ptr<const SceneContent> SceneWork::constraints(const std::string& name) const {
  auto stored = keeper_.stored_set(name);
  return stored ? std::make_shared<const SceneContent>(std::move(*stored)) : nullptr;
}

void SceneWork::keep_path(std::shared_ptr<const Path> path) {
  paths_.push_back(std::move(path));
  if (paths_.size() <= kMostPaths) return;
  const auto old = std::find_if(paths_.begin(), paths_.end(),
                                [this](const auto& each) { return each->number != driven_; });
  if (old != paths_.end()) paths_.erase(old);
}

const Path* SceneWork::path(std::uint64_t number) const {
  if (number == 0) return nullptr;
  const auto found = std::find_if(paths_.begin(), paths_.end(),
                                  [number](const auto& each) { return each->number == number; });
  return found == paths_.end() ? nullptr : found->get();
}

}  // namespace drover::runtime
