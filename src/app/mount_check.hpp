#pragma once

#include <filesystem>
#include <string>

#include "kestrel/loop/task.hpp"

namespace kestrel::app {

/// Prints a line of `check`: what it is about, and the words.
void say(const char* what, const std::string& text);

/// Prints what a task's mount means, and what the vehicle does about each change of the image;
/// draws it into the folder `drawings` unless that is empty. file: the task's.
void say_mount(const Task& task, const std::filesystem::path& file,
               const std::filesystem::path& drawings);

/// The same for a mount file, with the default law and a target squarely ahead.
void check_mount(const std::filesystem::path& file, const std::filesystem::path& drawings);

}  // namespace kestrel::app
