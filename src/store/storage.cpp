// The storage thread's work: one job in, one reply out, in order.
#include "store/storage.h"

#include <stdexcept>
#include <utility>

#include "store/kept_marks.h"

namespace drover::store {
namespace {

/// Makes the folders before the stores that live in them; their names must be durable too.
std::string prepared(Files& files, const std::string& folder) {
  const auto need = [](int error, const std::string& path) {
    if (error != 0) throw std::runtime_error(failure_text("use folder", path, error));
  };
  need(files.make_folder(folder), folder);
  need(files.make_folder(folder + "/tracks"), folder + "/tracks");
  // On a read-only disk these fail, and everything else goes on: without its folder each report is
  // lost, and told.
  (void)files.make_folder(folder + "/reports");
  (void)files.make_folder(folder + "/" + std::string(kMarksFolder));
  (void)files.sync_folder(folder);
  return folder;
}

std::vector<NamedText> written(const std::vector<SceneText>& texts) {
  std::vector<NamedText> all;
  all.reserve(texts.size());
  for (const SceneText& text : texts)
    all.push_back({text.kind, text.name, text.arrived_s, text.text->get()});
  return all;
}

}  // namespace

StoredFor stored_for(const StorageJob& job) {
  const bool of_reports = std::holds_alternative<SaveReport>(job.what) ||
                          std::holds_alternative<ListReports>(job.what) ||
                          std::holds_alternative<ReadReport>(job.what);
  if (of_reports) return StoredFor::reports;
  if (std::holds_alternative<SaveLearned>(job.what)) return StoredFor::learned;
  const bool of_scene =
      std::holds_alternative<SaveScene>(job.what) || std::holds_alternative<AcceptLoss>(job.what) ||
      std::holds_alternative<SaveZone>(job.what) || std::holds_alternative<DeleteZone>(job.what) ||
      std::holds_alternative<ForgetUnreadableZones>(job.what);
  return of_scene ? StoredFor::scene : StoredFor::tracks;
}

Storage::Storage(Files& files, const std::string& folder, const std::string& run_folder)
    : tracks_(files, prepared(files, folder) + "/tracks"),
      origin_(files, folder),
      stop_(files, folder),
      scene_(files, folder, run_folder),
      zones_(files, folder),
      reports_(files, folder + "/reports"),
      learned_(files, folder) {}

StoredState Storage::load(const std::optional<SceneAge>& scene) {
  StoredState state;
  state.tracks = tracks_.load(state.report);
  state.origin = origin_.load(state.report);
  state.origin_problem = origin_.problem();
  state.stop = stop_.load(state.report);
  state.learned = learned_.load(state.report);
  if (!scene) return state;
  StoredScene found;
  found.texts = scene_.load(scene->wall_s, scene->max_age_s, state.report);
  found.problem = scene_.problem();
  found.is_unsaved = scene_.is_unsaved();
  zones_.load();
  found.zones = zones_.zones();
  found.zones_problem = zones_.problem();
  state.scene = std::make_shared<const StoredScene>(std::move(found));
  return state;
}

StorageReply Storage::run(StorageJob job) {
  StorageReply reply;
  reply.id = job.id;
  reply.whose = stored_for(job);
  std::optional<Failure> failure;
  if (auto* save = std::get_if<SaveTrack>(&job.what)) {
    failure = tracks_.save(save->track);
    reply.track = std::move(save->track);
  } else if (const auto* one = std::get_if<DeleteTrack>(&job.what)) {
    failure = tracks_.remove(one->name);
  } else if (const auto* origin = std::get_if<SaveOrigin>(&job.what)) {
    failure = origin_.save(origin->origin);
  } else if (const auto* scene = std::get_if<SaveScene>(&job.what)) {
    failure = scene_.save(written(scene->texts));
  } else if (const auto* loss = std::get_if<AcceptLoss>(&job.what)) {
    failure = scene_.accept_loss(written(loss->texts));
  } else if (auto* zone = std::get_if<SaveZone>(&job.what)) {
    failure = zones_.save(zone->name, std::move(zone->text), zone->wall_s);
  } else if (const auto* gone = std::get_if<DeleteZone>(&job.what)) {
    failure = zones_.remove(gone->name);
  } else if (std::holds_alternative<ForgetUnreadableZones>(job.what)) {
    failure = zones_.forget_unreadable();
  } else if (const auto* report = std::get_if<SaveReport>(&job.what)) {
    failure = reports_.save(report->texts);
  } else if (std::holds_alternative<ListReports>(job.what)) {
    reply.reports = reports_.list();
  } else if (const auto* learned = std::get_if<SaveLearned>(&job.what)) {
    failure = learned_.save(learned->kept);
  } else if (const auto* wanted = std::get_if<ReadReport>(&job.what)) {
    auto found = reports_.read(wanted->number);
    if (found.ok()) reply.reports.push_back(std::move(found.value()));
    if (!found.ok()) failure = found.error();
  } else {
    failure = tracks_.remove_all(reply.removed);
  }
  reply.ok = !failure;
  if (failure) reply.reason = failure->text;
  return reply;
}

}  // namespace drover::store
