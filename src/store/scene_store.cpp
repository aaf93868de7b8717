// The scene's objects and constraints on disk, as texts of whoever understands them.
#include "store/scene_store.h"

#include <algorithm>
#include <utility>

#include "store/kept_marks.h"

namespace drover::store {
namespace {

/// Stands among the texts as long as a person does not know of it; its text is the problem.
constexpr std::string_view kLossKind = "loss";
const std::string kScene(kSceneFile.file);

bool is_loss(const NamedText& text) {
  return text.kind == kLossKind;
}

bool is_of_the_scene(const NamedText& text) {
  return text.kind == kObjectKind || text.kind == kConstraintKind;
}

}  // namespace

SceneStore::SceneStore(Files& files, std::string folder, std::string run_folder)
    : files_(files),
      folder_(std::move(folder)),
      spare_(files, std::move(run_folder), kUnsavedSceneFile) {}

std::vector<NamedText> SceneStore::load(double wall_s, std::optional<double> max_age_s,
                                        std::vector<std::string>& report) {
  auto found = load_named_texts(files_, folder_, kSceneFile);
  remove_leftovers(files_, folder_, kSceneFile);
  problem_.clear();
  is_foreign_ = found.is_foreign;
  if (is_foreign_) {
    problem_ = "the stored scene is not known: " + found.problem;
    report.push_back(found.problem);
    return {};
  }
  auto spare = spare_.load();
  is_unsaved_ = spare.is_there && spare.problem.empty();
  if (is_unsaved_) {
    found = std::move(spare);
    report.emplace_back("the scene is as it was: the disk had not taken the last of it");
  } else if (spare.is_there) {
    problem_ = "what the disk did not take of the scene is lost: " + spare.problem;
    report.push_back(problem_);
  }
  if (!found.problem.empty()) {
    problem_ = "the stored scene is lost: " + found.problem;
    report.push_back(found.problem + "; " + put_aside(files_, folder_, kScene));
    return {};
  }
  auto& texts = found.texts;
  const auto loss = std::find_if(texts.begin(), texts.end(), is_loss);
  if (loss != texts.end()) {
    problem_ = loss->text;
    texts.erase(loss);
  } else if (!found.is_there && lies_aside(files_, folder_, kScene)) {
    problem_ = "the stored scene is lost: " + gone_text(folder_, kScene);
    report.push_back(problem_);
  } else if (!found.is_there && was_kept(files_, folder_, kScene)) {
    problem_ = "the stored scene is lost: " + deleted_text(folder_, kScene);
    report.push_back(problem_);
  }
  if (found.is_there) mark_kept(files_, folder_, kScene);
  const auto is_old = [&](const NamedText& text) {
    return max_age_s && text.kind == kObjectKind && wall_s - text.arrived_s > *max_age_s;
  };
  if (const auto old = std::erase_if(texts, is_old); old > 0)
    report.push_back("objects of the stored scene that were too old: " + std::to_string(old));
  return std::move(texts);
}

std::optional<Failure> SceneStore::save(const std::vector<NamedText>& texts) {
  if (!std::all_of(texts.begin(), texts.end(), is_of_the_scene))
    return Failure{"a scene has objects and constraints only"};
  if (is_foreign_) return Failure{problem_};
  auto all = texts;
  if (!problem_.empty()) all.push_back({std::string(kLossKind), "", 0, problem_});
  spare_.before_save(all);
  auto failure = save_named_texts(files_, folder_, kSceneFile, all);
  spare_.after_save(all, !failure);
  if (!failure) mark_kept(files_, folder_, kScene);
  return failure;
}

std::optional<Failure> SceneStore::accept_loss(const std::vector<NamedText>& texts) {
  if (is_foreign_) return Failure{problem_};
  const std::string before = std::exchange(problem_, {});
  auto failure = save(texts);
  if (failure) problem_ = before;
  return failure;
}

}  // namespace drover::store
