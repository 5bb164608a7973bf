#include "guarded_server.hpp"

#include <stdexcept>
#include <utility>

#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <sys/resource.h>

namespace kestrel {
namespace {

using Context = std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)>;
using Bio = std::unique_ptr<BIO, int (*)(BIO*)>;

Bio reader(const std::string& pem) {
  return {BIO_new_mem_buf(pem.data(), int(pem.size())), BIO_free};
}

/// The certificate and, behind it, those that vouch for it.
bool use_chain(SSL_CTX* context, const std::string& pem) {
  const Bio from = reader(pem);
  X509* own = PEM_read_bio_X509(from.get(), nullptr, nullptr, nullptr);
  bool good = own != nullptr && SSL_CTX_use_certificate(context, own) == 1;
  X509_free(own);
  while (X509* next = PEM_read_bio_X509(from.get(), nullptr, nullptr, nullptr)) {
    good = good && SSL_CTX_add0_chain_cert(context, next) == 1;  // the context's from now on
  }
  return good;
}

bool use_key(SSL_CTX* context, const std::string& pem) {
  const Bio from = reader(pem);
  EVP_PKEY* key = PEM_read_bio_PrivateKey(from.get(), nullptr, nullptr, nullptr);
  const bool good = key != nullptr && SSL_CTX_use_PrivateKey(context, key) == 1;
  EVP_PKEY_free(key);
  return good;
}

Context context_of(const std::optional<TlsIdentity>& identity) {
  if (!identity) return {nullptr, SSL_CTX_free};
  Context context(SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
  const bool good = context && SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION) == 1 &&
                    use_chain(context.get(), identity->certificate_pem()) &&
                    use_key(context.get(), identity->key_pem());
  if (!good) throw std::runtime_error("TLS: OpenSSL does not take the certificate");
  SSL_CTX_set_mode(context.get(),
                   SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  return context;
}

}  // namespace

void give_way() {
  constexpr int kMore = 5;
  // 0: the calling thread. Nothing depends on it where the system refuses.
  ::setpriority(PRIO_PROCESS, 0, ::getpriority(PRIO_PROCESS, 0) + kMore);
}

Workers::Workers(std::size_t threads, std::function<void()> crowded, std::function<void()> start)
    : crowded_(std::move(crowded)), start_(std::move(start)), idle_(threads) {
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

void Workers::enqueue(std::function<void()> job) {
  bool is_crowded = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    jobs_.push_back(std::move(job));
    is_crowded = jobs_.size() > idle_;
  }
  changed_.notify_one();
  if (is_crowded) crowded_();
}

void Workers::shutdown() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Workers::work() {
  start_();
  while (true) {
    std::function<void()> job;
    bool is_crowded = false;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [&] { return closed_ || !jobs_.empty(); });
      --idle_;
      if (jobs_.empty()) return;  // all that came have been served: their sockets are closed
      job = std::move(jobs_.front());
      jobs_.pop_front();
      is_crowded = jobs_.size() > idle_;  // when these came there may have been none to cut
    }
    if (is_crowded) crowded_();
    job();
    const std::lock_guard<std::mutex> lock(mutex_);
    ++idle_;
  }
}

GuardedServer::GuardedServer(GuardedOptions options, ConnectionCounts& counts)
    : options_(std::move(options)), counts_(counts), tls_(context_of(options_.tls)) {
  new_task_queue = [this] {
    return new Workers(
        options_.threads, [this] { table_.make_room(); }, options_.start);
  };
}

void GuardedServer::widen_queue() {
  constexpr int kWaiting = 1024;
  ::listen(svr_sock_, kWaiting);  // a second call changes the length only (listen(2))
}

Tls GuardedServer::new_tls() const { return {tls_ ? SSL_new(tls_.get()) : nullptr, SSL_free}; }

/// One request and its answer; the count that it is to be added to, null when it was in order.
std::atomic<long>* GuardedServer::serve(Connection& connection) {
  if (!connection.greet()) {
    if (!connection.has_heard()) return nullptr;
    return connection.was_slow() ? &counts_.slow : &counts_.no_tls;
  }
  bool closed = false;
  bool understood = false;
  bool too_long = false;
  process_request(connection, true, closed, [&](httplib::Request& request) {
    understood = true;
    too_long = request.get_header_value<std::uint64_t>("Content-Length") > payload_max_length_;
    request.ranges.clear();  // a thousand ranges of one file would be a thousand copies of it
    if (!options_.trusts(request)) return;
    connection.trust();
    table_.trust(connection.socket());
  });
  if (!connection.has_heard()) return nullptr;  // opened ahead of need, as browsers do
  if (too_long || connection.was_huge()) return &counts_.huge;
  if (connection.was_slow()) return &counts_.slow;
  return understood ? nullptr : &counts_.malformed;
}

bool GuardedServer::process_and_close_socket(socket_t socket) {
  table_.enter(socket);
  {
    Connection connection(socket, options_.limits, new_tls());
    std::atomic<long>* refused = serve(connection);
    connection.end();
    if (table_.leave(socket)) refused = &counts_.crowded;
    if (refused != nullptr) ++*refused;
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return true;
}

}  // namespace kestrel
