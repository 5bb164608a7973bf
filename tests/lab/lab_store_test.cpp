#include "kestrel/lab/lab_store.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kestrel/io/text_file.hpp"

#include "lab/made_up_runs.hpp"
#include "support/temp_folder.hpp"

namespace kestrel {
namespace {

namespace fs = std::filesystem;

StoredRun stored(const std::string& law, double value) {
  StoredRun out{"digest", storable(test::made_up_run("S0", law, value))};
  out.run.law_us = 9.25;
  out.run.end = RunEnd::Refused;
  out.run.refusal = LawRefusal::Collinear;
  out.run.modifier = "kz2";
  out.run.kind = RunKind::Helicopter;
  return out;
}

void expect_same(const LabRun& a, const LabRun& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.scenario + a.law + a.modifier, b.scenario + b.law + b.modifier);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.end, b.end);
  EXPECT_EQ(a.refusal, b.refusal);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.metrics, b.metrics);
  EXPECT_EQ(a.law_us, b.law_us);
  EXPECT_EQ(a.trace.columns, b.trace.columns);
  ASSERT_EQ(a.trace.rows.size(), b.trace.rows.size());
  EXPECT_TRUE(std::isnan(b.trace.rows[1][2]));
  EXPECT_EQ(a.trace.rows[2], b.trace.rows[2]);
}

TEST(LabStore, GivesBackWhatWasKeptBeforeAndAfterItIsSealed) {
  const test::TempFolder folder;
  LabStore store(folder / "out");
  EXPECT_TRUE(store.load().empty());
  const StoredRun one = stored("cur", 1 / 7.);
  store.keep(one);
  for (const char* when : {"kept", "sealed"}) {
    SCOPED_TRACE(when);
    const auto runs = LabStore(folder / "out").load();
    ASSERT_EQ(runs.count("S0/cur"), 1u);
    EXPECT_EQ(runs.at("S0/cur").inputs, "digest");
    expect_same(one.run, runs.at("S0/cur").run);
    store.seal({&one});
  }
  EXPECT_TRUE(fs::exists(folder / "out/runs/S0/cur.csv"));
  EXPECT_FALSE(fs::exists(folder / "out/finished.part.jsonl"));
}

TEST(LabStore, TimesStandInAFileOfTheirOwn) {
  const test::TempFolder folder;
  LabStore store(folder.path());
  StoredRun run = stored("cur", 1);
  store.keep(run);
  store.seal({&run});
  const std::string text = read_text(folder / "finished.jsonl");
  run.run.law_us = 1;
  store.seal({&run});
  EXPECT_EQ(read_text(folder / "finished.jsonl"), text);
  EXPECT_EQ(read_text(folder / "timing.csv"), "id,law_us\nS0/cur,1\n");
}

TEST(LabStore, SealingLeavesTheseRunsInThisOrderAndNoOther) {
  const test::TempFolder folder;
  LabStore store(folder.path());
  const StoredRun runs[] = {stored("cur", 1), stored("des", 2), stored("mean", 3)};
  for (const StoredRun& run : runs) store.keep(run);
  store.seal({&runs[2], &runs[0]});
  const std::string text = read_text(folder / "finished.jsonl");
  EXPECT_LT(text.find("S0/mean"), text.find("S0/cur"));
  EXPECT_EQ(text.find("S0/des"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "runs/S0/des.csv"));
  EXPECT_TRUE(fs::exists(folder / "runs/S0/mean.csv"));
}

TEST(LabStore, PassesOverWhatIsNotWhole) {
  const test::TempFolder folder;
  LabStore store(folder.path());
  for (const char* law : {"cur", "des", "mean"}) store.keep(stored(law, 1));
  std::string text = read_text(folder / "finished.part.jsonl");
  folder.write("finished.part.jsonl", text.substr(0, text.size() - 9));  // killed while writing
  folder.write("runs/S0/des.csv", "step,time_s\n0,0\n");
  const auto runs = store.load();
  EXPECT_EQ(runs.size(), 1u);
  EXPECT_EQ(runs.count("S0/cur"), 1u);
}

TEST(LabStore, AFullDiskAndAFileInTheWayAreNamed) {
  const test::TempFolder folder;
  fs::create_symlink("/dev/full", folder / "finished.part.jsonl");
  LabStore store(folder.path());
  StoredRun run = stored("cur", 1);
  EXPECT_THAT(test::message_of([&] { store.keep(run); }),
              ::testing::AllOf(::testing::HasSubstr("finished.part.jsonl"),
                               ::testing::HasSubstr("No space left"),
                               ::testing::HasSubstr("free some space")));
  folder.write("file", "in the way");
  LabStore blocked(folder / "file");
  EXPECT_THAT(test::message_of([&] { blocked.keep(run); }), ::testing::HasSubstr("file/runs/S0"));
}

TEST(LabStore, IdsBecomePlainFileNames) {
  EXPECT_EQ(path_of_id("S3_rz90/2.5d/kz2"), fs::path("S3_rz90/2.5d/kz2"));
  const std::string strange = path_of_id("../my law/kz*2").string();
  for (const fs::path& part : fs::path(strange)) EXPECT_NE(part, "..");
}

}  // namespace
}  // namespace kestrel
