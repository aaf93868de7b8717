// Checks of the parts of a message: each tells the first thing that is wrong, with its place.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/message/header.h"
#include "scene/message/refusal.h"
#include "scene/message/shapes.h"

namespace drover::scene::check {

/// Nothing: all is well.
using Problem = std::optional<Refusal>;
using Notes = std::vector<std::string>;

/// Up to kMaxNotes of them; the last one is "and more".
void note(Notes& notes, std::string whole);
/// "path: text".
void note(Notes& notes, const std::string& path, std::string_view text);
/// "path.name"; only "name" at the top.
std::string member(const std::string& path, std::string_view name);
/// "path[3]".
std::string element(const std::string& path, std::size_t index);

/// Finite and inside the bounds.
Problem number(const std::string& path, double value, double least, double most);
/// May be empty; no control characters, and not over kMaxNameBytes.
Problem text(const std::string& path, std::string_view value);
/// A text that is not empty.
Problem name(const std::string& path, std::string_view value);

/// A header that gives what it stands over a place: a frame, and a time that is one.
Problem header(const std::string& path, const Header& header);
Problem position(const std::string& path, const Vector3& position_m);
/// Takes all zero for identity; gives it unit length when it is near it.
Problem orientation(const std::string& path, Quaternion& orientation, Notes& notes);
Problem pose(const std::string& path, Pose& pose, Notes& notes);
/// Poses of so many shapes: those that are missing are identity.
Problem poses(const std::string& path, std::vector<Pose>& poses, std::size_t shapes, Notes& notes);

Problem primitives(const std::string& path, const std::vector<SolidPrimitive>& primitives);
Problem meshes(const std::string& path, const std::vector<Mesh>& meshes);
Problem planes(const std::string& path, const std::vector<Plane>& planes);

}  // namespace drover::scene::check
