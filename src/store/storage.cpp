// The storage thread's work: one job in, one reply out, in order.
#include "store/storage.h"

#include <stdexcept>
#include <type_traits>
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

template <class Job, class... Jobs>
constexpr bool is_one_of = (std::is_same_v<Job, Jobs> || ...);

/// One function for each kind of job. A kind that has none does not compile: there is no rest,
/// which could be a deletion.
template <class... Functions>
struct ForEach : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
ForEach(Functions...) -> ForEach<Functions...>;

}  // namespace

StoredFor stored_for(const StorageJob& job) {
  return std::visit(
      []<class Job>(const Job&) {
        if constexpr (is_one_of<Job, SaveReport, ListReports, ReadReport>) {
          return StoredFor::reports;
        } else if constexpr (is_one_of<Job, SaveLearned>) {
          return StoredFor::learned;
        } else if constexpr (is_one_of<Job, SaveScene, AcceptLoss, SaveZone, DeleteZone,
                                       ForgetUnreadableZones>) {
          return StoredFor::scene;
        } else {
          static_assert(is_one_of<Job, SaveTrack, DeleteTrack, DeleteAllTracks, SaveOrigin>);
          return StoredFor::tracks;
        }
      },
      job.what);
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
  const std::optional<Failure> failure = std::visit(
      ForEach{
          [&](SaveTrack& save) {
            auto failed = tracks_.save(save.track);
            reply.track = std::move(save.track);
            return failed;
          },
          [&](DeleteTrack& one) { return tracks_.remove(one.name); },
          [&](DeleteAllTracks&) { return tracks_.remove_all(reply.removed); },
          [&](SaveOrigin& save) { return origin_.save(save.origin); },
          [&](SaveScene& save) { return scene_.save(written(save.texts)); },
          [&](AcceptLoss& loss) { return scene_.accept_loss(written(loss.texts)); },
          [&](SaveZone& zone) { return zones_.save(zone.name, std::move(zone.text), zone.wall_s); },
          [&](DeleteZone& zone) { return zones_.remove(zone.name); },
          [&](ForgetUnreadableZones&) { return zones_.forget_unreadable(); },
          [&](SaveReport& report) { return reports_.save(report.texts); },
          [&](ListReports&) -> std::optional<Failure> {
            reply.reports = reports_.list();
            return std::nullopt;
          },
          [&](ReadReport& wanted) -> std::optional<Failure> {
            auto found = reports_.read(wanted.number);
            if (!found.ok()) return found.error();
            reply.reports.push_back(std::move(found.value()));
            return std::nullopt;
          },
          [&](SaveLearned& learned) { return learned_.save(learned.kept); }},
      job.what);
  reply.ok = !failure;
  if (failure) reply.reason = failure->text;
  return reply;
}

}  // namespace drover::store
