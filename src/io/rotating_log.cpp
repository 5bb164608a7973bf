#include "kestrel/io/rotating_log.hpp"

#include <stdexcept>
#include <system_error>
#include <utility>

#include "kestrel/io/text_file.hpp"

namespace kestrel {

void RotatingLogOptions::check() const {
  if (max_bytes < 1000) throw std::invalid_argument("max_bytes must be at least 1000");
  if (files < 1 || files > 100) throw std::invalid_argument("files must be 1 to 100");
  if (max_waiting < 1) throw std::invalid_argument("max_waiting must be at least 1");
}

RotatingLog::RotatingLog(std::filesystem::path file, const RotatingLogOptions& options)
    : file_(std::move(file)), options_(options), out_(file_, std::ios::app) {
  options_.check();
  if (!out_) throw FileError(file_, 0, "", "cannot be written; name another file for the log");
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(file_, none);
  size_ = none ? 0 : size;
  writer_ = std::thread([this] { work(); });
}

RotatingLog::~RotatingLog() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  wake_.notify_one();
  writer_.join();
}

void RotatingLog::write(std::string line) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.size() >= options_.max_waiting) {
      ++dropped_;
      ++untold_;
      return;
    }
    waiting_.push_back(std::move(line));
  }
  wake_.notify_one();
}

std::uint64_t RotatingLog::dropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return dropped_;
}

void RotatingLog::work() {
  for (bool ends = false; !ends;) {
    std::deque<std::string> lines;
    std::uint64_t untold = 0;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      wake_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
      lines.swap(waiting_);
      untold = std::exchange(untold_, 0);
      ends = ends_;
    }
    for (const std::string& line : lines) put(line);
    if (untold > 0) put("{\"event\":\"lines dropped\",\"count\":" + std::to_string(untold) + "}");
    out_.flush();
  }
}

void RotatingLog::put(const std::string& line) {
  if (size_ > 0 && size_ + line.size() + 1 > options_.max_bytes) rotate();
  out_ << line << '\n';
  size_ += line.size() + 1;
}

/// Each file takes the place of the next older one. What the file system refuses is passed over:
/// then the file is begun anew, for it must not grow.
void RotatingLog::rotate() {
  out_.close();
  const auto older = [this](int i) {
    return i == 0 ? file_ : std::filesystem::path(file_.string() + "." + std::to_string(i));
  };
  std::error_code ignored;
  for (int i = options_.files - 1; i > 0; --i) {
    std::filesystem::rename(older(i - 1), older(i), ignored);
  }
  out_.clear();
  out_.open(file_, std::ios::trunc);
  size_ = 0;
}

}  // namespace kestrel
