// What an import of a zone gives: polygons, or the place in the file that is wrong.
#include "scene/zone/import.h"

namespace drover::scene {

std::string ImportError::text() const {
  std::string text;
  if (line > 0) text = "line " + std::to_string(line);
  if (column > 0) text += ", column " + std::to_string(column);
  if (!path.empty()) text += text.empty() ? path : " (" + path + ")";
  return text.empty() ? what : text + ": " + what;
}

}  // namespace drover::scene
