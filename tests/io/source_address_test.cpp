#include "kestrel/io/source_address.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

using test::message_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(SourceAddress, TakesEverySchemeApart) {
  struct Case {
    const char* text;
    SourceKind kind;
    const char* place;
    bool live;
  };
  for (const Case& c :
       {Case{"sequence:a/b.yaml", SourceKind::Sequence, "a/b.yaml", false},
        Case{"images:a/%04d.png", SourceKind::Images, "a/%04d.png", false},
        Case{"video:v.mp4", SourceKind::Video, "v.mp4", false},
        Case{"camera:0", SourceKind::V4l2, "0", true},
        Case{"camera:/dev/v4l/by-id/x", SourceKind::V4l2, "/dev/v4l/by-id/x", true},
        Case{"dc1394", SourceKind::Dc1394, "", true}, Case{"dc1394:", SourceKind::Dc1394, "", true},
        Case{"dc1394:0123", SourceKind::Dc1394, "0123", true},
        Case{"rtsp://h/x", SourceKind::Network, "rtsp://h/x", true},
        Case{"rtp:s.sdp", SourceKind::Network, "rtp:s.sdp", true},
        Case{"rtp://h:5", SourceKind::Network, "rtp://h:5", true},
        Case{"udp://:5", SourceKind::Network, "udp://:5", true},
        Case{"http://h/x", SourceKind::Network, "http://h/x", true},
        Case{"https://h/x", SourceKind::Network, "https://h/x", true},
        Case{"simulation", SourceKind::Simulation, "", false}}) {
    const SourceAddress a = parse_source(c.text);
    EXPECT_EQ(a.kind, c.kind) << c.text;
    EXPECT_EQ(a.place, c.place) << c.text;
    EXPECT_EQ(a.text, c.text);
    EXPECT_EQ(is_live(a.kind), c.live) << c.text;
    EXPECT_TRUE(is_source_address(c.text)) << c.text;
  }
}

TEST(SourceAddress, AnUnknownSchemeIsToldTheKnownOnes) {
  for (const char* text : {"webcam", "ftp://x", "", "dc1394x", "simulations", "a/b.yaml"}) {
    EXPECT_FALSE(is_source_address(text)) << text;
    EXPECT_THAT(message_of([&] { parse_source(text); }),
                AllOf(HasSubstr("is '" + std::string(text) + "'"), HasSubstr("sequence:FILE"),
                      HasSubstr("camera:N"), HasSubstr("dc1394:GUID"), HasSubstr("rtsp://"),
                      HasSubstr("rtp:"), HasSubstr("udp://"), HasSubstr("http://")))
        << text;
  }
  EXPECT_THAT(message_of([] { parse_source("camra:0"); }), HasSubstr("did you mean camera:?"));
  EXPECT_THAT(message_of([] { parse_source("rstp://h"); }), HasSubstr("did you mean"));
}

TEST(SourceAddress, ASchemeWithoutAPlaceIsRefused) {
  for (const char* text : {"sequence:", "images:", "video:", "camera:", "rtsp://", "rtp:"}) {
    EXPECT_THAT(message_of([&] { parse_source(text); }), HasSubstr("names no file")) << text;
  }
}

}  // namespace
}  // namespace kestrel
