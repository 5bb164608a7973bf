// A ground station over TLS, met by a real client of OpenSSL.
#include <fstream>

#include <gtest/gtest.h>

#include "ground/idle_station.hpp"
#include "ground/raw_connection.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::RawConnection;

class StationTls : public test::IdleStation {
 protected:
  static GroundOptions with(const TlsIdentity& identity) {
    GroundOptions options;
    options.tls = identity;
    return options;
  }
  /// One that trusts this certificate and no other.
  std::unique_ptr<httplib::SSLClient> client(std::uint16_t port, const TlsIdentity& trusted) {
    std::ofstream(folder_ / "trusted.pem") << trusted.certificate_pem();
    auto made = std::make_unique<httplib::SSLClient>("127.0.0.1", port);
    made->set_ca_cert_path((folder_ / "trusted.pem").c_str());
    made->enable_server_certificate_verification(true);
    return made;
  }
  httplib::Headers bearer() const { return {{"Authorization", "Bearer " + token_.text()}}; }

  const test::TempFolder folder_;
  const TlsIdentity identity_ = self_signed_identity("127.0.0.1");
  const std::unique_ptr<GroundStation> station_ = station(with(identity_));
};

TEST_F(StationTls, AClientThatKnowsTheCertificateIsServed) {
  const auto page = client(station_->port(), identity_)->Get("/");
  ASSERT_TRUE(page) << to_string(page.error());
  EXPECT_EQ(page->status, 200);
  const std::string own = "https://127.0.0.1:" + std::to_string(station_->command_port());
  EXPECT_NE(page->get_header_value("Content-Security-Policy").find(own), std::string::npos);
  EXPECT_EQ(station_->address().find("https://127.0.0.1:"), 0u);
}

TEST_F(StationTls, AClientThatKnowsAnotherCertificateRefusesIt) {
  const auto page = client(station_->port(), self_signed_identity("127.0.0.1"))->Get("/");
  EXPECT_EQ(page.error(), httplib::Error::SSLServerVerification);
}

TEST_F(StationTls, CommandsComeFromItsOwnPageOnly) {
  const auto commands = client(station_->command_port(), identity_);
  httplib::Headers headers = bearer();
  headers.emplace("Origin", "http://127.0.0.1:" + std::to_string(station_->port()));
  EXPECT_EQ(commands->Post("/command", headers, R"({"do":"abort"})", "application/json")->status,
            403)
      << "a page that came without TLS is another page";
  headers = bearer();
  headers.emplace("Origin", "https://127.0.0.1:" + std::to_string(station_->port()));
  EXPECT_EQ(commands->Post("/command", headers, R"({"do":"abort"})", "application/json")->status,
            200);
  EXPECT_EQ(station_->desk().mode(), FlightMode::Aborted);
}

TEST_F(StationTls, FramesComeWhole) {
  StreamReader reader;
  int seen = 0;
  std::atomic<bool> done{false};
  std::thread shower([&] {
    GroundView view;
    view.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(100));
    while (!done) {
      ++view.row.frame;
      station_->show(view);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  client(station_->port(), identity_)
      ->Get("/stream", bearer(), [&](const char* data, std::size_t size) {
        reader.add({data, size});
        while (const auto frame = reader.next()) seen += frame->jpeg.empty() ? 0 : 1;
        return seen < 10;
      });
  done = true;
  shower.join();
  EXPECT_GE(seen, 10);
}

TEST_F(StationTls, PlainHttpIsToldAndCounted) {
  RawConnection plain(station_->command_port());
  plain.send("POST /command HTTP/1.1\r\nAuthorization: Bearer " + token_.text() +
             "\r\nContent-Length: 14\r\n\r\n{\"do\":\"abort\"}");
  const std::string answer = plain.rest(2);
  EXPECT_NE(answer.find("400"), std::string::npos) << answer;
  EXPECT_NE(answer.find("https://"), std::string::npos) << answer;
  EXPECT_EQ(station_->desk().mode(), FlightMode::Hover);
  EXPECT_TRUE(comes([&] { return station_->refusals().no_tls == 1; }));
}

TEST_F(StationTls, AHandshakeThatDripsIsCut) {
  GroundOptions impatient = with(identity_);
  impatient.request_s = 0.1;
  const auto dripped_on = station(impatient);
  RawConnection slow(dripped_on->command_port());
  slow.send("\x16\x03\x01\x02");  // a ClientHello of 512 bytes begins
  EXPECT_TRUE(comes([&] { return !slow.send(std::string(1, '\0')); }));
  EXPECT_TRUE(comes([&] { return dripped_on->refusals().slow == 1; }));
}

TEST_F(StationTls, BeyondThisMachineIsTlsOrSaidAloud) {
  GroundOptions options;
  options.host = "0.0.0.0";
  EXPECT_THROW(options.check(), std::invalid_argument);
  options.allows_plain = true;
  options.check();
  options.allows_plain = false;
  options.tls = identity_;
  options.check();
}

TEST_F(StationTls, WhereNothingFliesCommandsAreRefusedInWords) {
  GroundOptions options;
  options.view_only = "nothing flies here";
  const auto looked_at = station(options);
  test::StationClient client(*looked_at, token_);
  const auto answer = client.post(R"({"do":"abort"})");
  EXPECT_EQ(answer.status, 409);
  EXPECT_NE(answer.body.find("nothing flies here"), std::string::npos);
  EXPECT_EQ(looked_at->refusals().view_only, 1);
}

}  // namespace
}  // namespace kestrel
