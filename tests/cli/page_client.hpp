#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>

#include <httplib.h>

#include <nlohmann/json.hpp>
#undef _res  // a macro of resolv.h

namespace kestrel::test {

/// A page without a browser: posts commands, and holds the sticks as the page's script does.
class PageClient {
 public:
  PageClient(int port, const std::string& token)
      : page_("127.0.0.1", port),
        commands_("127.0.0.1", port + 1),
        stops_("127.0.0.1", port + 2),
        bearer_({{"Authorization", "Bearer " + token}}) {}
  ~PageClient() { let_go_silently(); }
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;

  /// Null while nothing answers.
  nlohmann::json status() {
    const auto answer = page_.Get("/status", bearer_);
    return answer && answer->status == 200 ? nlohmann::json::parse(answer->body) : nlohmann::json();
  }
  /// The words and the mode that a command is answered; more: ",\"key\":value".
  nlohmann::json give(const std::string& word, const std::string& more = "") {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (client_.empty()) client_ = post(R"({"do":"join"})")["client"];
    return post(R"({"do":")" + word + R"(","client":")" + client_ + R"(","number":)" +
                std::to_string(++number_) + more + '}');
  }
  /// True when the emergency stop's own port took it.
  bool stop() {
    const auto answer = stops_.Post("/stop", bearer_, "", "text/plain");
    return answer && answer->status == 200;
  }

  /// Takes the sticks and pushes them forward until it lets go.
  void hold(double forward_m_s) {
    give("grip");
    done_ = false;
    hand_ = std::thread([this, forward_m_s] {
      while (!done_) {
        give("sticks", R"(,"velocity":[)" + std::to_string(forward_m_s) + ",0,0,0]");
        std::this_thread::sleep_for(std::chrono::milliseconds(80));
      }
    });
  }
  /// The hand is gone, and no hover was sent.
  void let_go_silently() {
    done_ = true;
    if (hand_.joinable()) hand_.join();
  }

 private:
  nlohmann::json post(const std::string& body) {
    const auto answer = commands_.Post("/command", bearer_, body, "application/json");
    return answer ? nlohmann::json::parse(answer->body) : nlohmann::json();
  }

  httplib::Client page_;
  httplib::Client commands_;
  httplib::Client stops_;
  httplib::Headers bearer_;
  std::mutex mutex_;
  std::string client_;
  std::uint64_t number_ = 0;
  std::atomic<bool> done_{true};
  std::thread hand_;
};

}  // namespace kestrel::test
