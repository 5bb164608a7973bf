#include "mount_check.hpp"

#include <optional>

#include <fmt/format.h>

#include "kestrel/io/csv.hpp"
#include "kestrel/io/mount_file.hpp"
#include "kestrel/io/mount_picture.hpp"
#include "kestrel/io/mount_sketch.hpp"
#include "kestrel/loop/mount_response.hpp"

namespace kestrel::app {
namespace {

namespace fs = std::filesystem;

/// Never over a drawing that is there: files of one name may lie in different folders.
fs::path free_name(const fs::path& file, const fs::path& folder) {
  const std::string stem = file.stem().string();
  const std::string base = stem.rfind("mount", 0) == 0 ? stem : stem + "_mount";
  fs::path picture = folder / (base + ".svg");
  for (int i = 2; fs::exists(picture); ++i) picture = folder / fmt::format("{}-{}.svg", base, i);
  return picture;
}

void draw(const fs::path& file, const Mount& mount, const std::optional<Camera>& camera,
          const fs::path& folder) {
  if (folder.empty()) return;
  const fs::path picture = free_name(file, folder);
  write_text(picture, mount_picture(mount, camera));
  say("drawn", picture.string());
}

void sketch(const Mount& mount) {
  for (const std::string& line : mount_sketch(mount)) say("", line);
}

void say_responses(const Task& task) {
  for (const MountResponse& response : mount_responses(task)) say("", describe(response));
}

}  // namespace

void say(const char* what, const std::string& text) { fmt::print("  {:<12} {}\n", what, text); }

void say_mount(const Task& task, const fs::path& file, const fs::path& drawings) {
  say("mount", describe(task.body_from_camera));
  sketch(task.body_from_camera);
  say_responses(task);
  draw(file, task.body_from_camera, task.camera, drawings);
}

void check_mount(const fs::path& file, const fs::path& drawings) {
  const Mount mount = load_mount(file);
  fmt::print("{}: a mount: {}\n", file.string(), describe(mount));
  sketch(mount);
  say_responses(task_with_mount(mount));
  draw(file, mount, std::nullopt, drawings);
}

}  // namespace kestrel::app
