// Which files were ever written: one of them that is not there was deleted, and was not "never".
#pragma once

#include <string>
#include <string_view>

#include "store/files.h"

namespace drover::store {

/// Drover replaces its files and never deletes one, so a mark beside them is enough: an empty file
/// of the same name in a folder of its own, which `rm scene.*` does not meet. A mark is made after
/// the file, so that a power cut between both tells of nothing that was not there.
inline constexpr std::string_view kMarksFolder = "kept";

/// Whether `folder/name` was written once. A mark that cannot be looked at counts: fail closed.
bool was_kept(Files& files, const std::string& folder, const std::string& name);

/// Call it when `folder/name` is durable, and when it was found: a mark that cannot be made, as on
/// a full disk, is made then, or at the next start.
void mark_kept(Files& files, const std::string& folder, const std::string& name);

/// "/state/scene.texts was deleted"
std::string deleted_text(const std::string& folder, const std::string& name);
/// "/state/scene.texts was damaged or deleted": one that was put aside lies there still.
std::string gone_text(const std::string& folder, const std::string& name);

}  // namespace drover::store
