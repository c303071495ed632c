#include "base/tool.h"

#include <omp.h>

#include <nlohmann/json.hpp>

#include "base/hash.h"
#include "folder_test.h"

namespace vsgl {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::set<std::string>;

struct Outcome {
  int status = 0;
  std::string out, err;
  bool worked = false;  // the body ran
  Provenance provenance;
  int count = 0;
  int threads = 0;
};

class ToolTest : public test::FolderTest {
 protected:
  void SetUp() override {
    test::FolderTest::SetUp();
    write("rsm.exr", "rsm");
    write("scene.json", "scene");
  }

  // A tool with options of every kind, run in this process. `body` may replace what it does.
  Outcome run(std::vector<std::string> arguments,
              const std::function<Exit(Tool&, Report&, OutputSet&)>& body = {}) {
    Tool tool("vsgl-gen", "samples lights");
    std::filesystem::path scene, rsm, output, map;
    int count = 1024;
    double scale = 1;
    std::string method = "fis";
    std::array<double, 3> offset{0, 0, 0};
    std::vector<int> sizes{1, 2};
    bool dump = false;
    tool.input("scene", scene, "scene")->required();
    tool.input("--rsm", rsm, "RSM to sample");
    tool.output("-o,--output", output, "lights to write")->required();
    tool.output("--map", map, "map to write");
    tool.app().add_option("--count", count, "number of lights")->check(CLI::Range(1, 1048576));
    tool.app().add_option("--kernel-scale", scale, "scale")->check(CLI::Range(0.1, 10.0));
    tool.app().add_option("--method", method, "method")->check(CLI::IsMember({"vpl", "fis"}));
    tool.app().add_option("--offset", offset, "offset X,Y,Z")->delimiter(',');
    tool.app().add_option("--sizes", sizes, "sizes")->delimiter(',');
    tool.app().add_flag("--dump", dump, "dump the lights")->excludes(tool.app().get_option("--sizes"));

    arguments.insert(arguments.begin(), "vsgl-gen");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    Outcome outcome;
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    outcome.status =
        tool.run(static_cast<int>(argv.size()), argv.data(), [&](Report& report, OutputSet& outputs) -> Exit {
          outcome.worked = true;
          outcome.threads = omp_get_max_threads();
          if (body) return body(tool, report, outputs);
          outcome.provenance = tool.provenance();
          write_text(outputs.add(output), "lights");
          report.count("lights", count);
          report.skipped("specular lobes", "no specular texel");
          return Exit::ok;
        });
    outcome.out = ::testing::internal::GetCapturedStdout();
    outcome.err = ::testing::internal::GetCapturedStderr();
    outcome.count = count;
    return outcome;
  }

  // The arguments of a run that succeeds, with `more` behind them.
  std::vector<std::string> good(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{path("scene.json"), "-o", path("out.exr")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  // The run must end with that error, say it in one line on stderr, nothing on stdout, and leave no file.
  void expect_failure(ErrorCode code, const std::string& text, const std::vector<std::string>& arguments) {
    const Names before = listing();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, static_cast<int>(exit_of(code)));
    EXPECT_TRUE(outcome.err.starts_with("vsgl-gen: error E" + std::to_string(static_cast<int>(code)) + ": "))
        << outcome.err;
    EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(outcome.worked);
    EXPECT_EQ(listing(), before);
  }

  // Runs with a --config file of that text.
  Outcome run_config(const std::string& text, const std::vector<std::string>& more = {}) {
    write("config.json", text);
    std::vector<std::string> arguments{"--config", path("config.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  void expect_config_failure(ErrorCode code, const std::string& message, const std::string& text) {
    write("config.json", text);
    expect_failure(code, message, {"--config", path("config.json")});
  }
};

TEST_F(ToolTest, RunsAndWritesItsOutput) {
  const Outcome outcome = run(good());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(read("out.exr"), "lights");
  EXPECT_NE(outcome.out.find("lights                       1024\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("skipped specular lobes: no specular texel\n"), std::string::npos)
      << outcome.out;
}

TEST_F(ToolTest, JsonIsOneObject) {
  const Outcome outcome = run(good({"--json"}));
  const Json result = Json::parse(outcome.out);
  EXPECT_EQ(result["$schema"], "vsgltools/result/1");
  EXPECT_EQ(result["tool"], "vsgl-gen");
  EXPECT_EQ(result["version"], VSGL_VERSION);
  EXPECT_EQ(result["outputs"], Json::array({"out.exr"}));
  EXPECT_EQ(result["counts"]["lights"], 1024);
  EXPECT_EQ(result["skipped"][0]["what"], "specular lobes");
  EXPECT_TRUE(result.contains("phases") && result.contains("warnings"));
}

TEST_F(ToolTest, QuietPrintsNothing) {
  const Outcome outcome = run(good({"-q"}));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(ToolTest, HelpListsEveryFlagAndVersionNamesTheTool) {
  const Outcome help = run({"--help"});
  EXPECT_EQ(help.status, 0);
  for (const std::string flag :
       {"--help", "--version", "--config", "--device", "--threads", "--seed", "--json", "--dry-run",
        "--overwrite", "--progress", "-q, --quiet", "-v, --verbose", "--no-skip", "-o, --output",
        "--count INT in [1 - 1048576] (default: 1024)", "--method {vpl,fis} (default: fis)", "samples lights",
        "scene FILE (required)"}) {
    EXPECT_NE(help.out.find(flag), std::string::npos) << flag << "\n" << help.out;
  }
  const Outcome version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.out, "vsgl-gen (vsgltools) " VSGL_VERSION "\n");
}

TEST_F(ToolTest, UnknownFlagsSuggestTheNearest) {
  expect_failure(ErrorCode::unknown_option, "--cuont: no such option; did you mean --count?",
                 {"--cuont", "5"});
  expect_failure(ErrorCode::unknown_option, "did you mean --count?", good({"--cuont=5"}));
  expect_failure(ErrorCode::unknown_option, "-x: no such option", {"-x"});
  expect_failure(ErrorCode::unknown_option, "-x: no such option", good({"-x"}));
}

TEST_F(ToolTest, BadValues) {
  expect_failure(ErrorCode::bad_value, "--count: expected an integer, got \"abc\"", good({"--count", "abc"}));
  expect_failure(ErrorCode::bad_value, "--count: expected an integer, got \"1.5\"", good({"--count", "1.5"}));
  expect_failure(ErrorCode::bad_value, "--count: needs a value", good({"--count"}));
  expect_failure(ErrorCode::bad_value, "--count: expected 1 value(s), got 2",
                 good({"--count", "1", "--count", "2"}));
  expect_failure(ErrorCode::bad_value, "--method: \"vp\" is not one of {vpl,fis}", good({"--method", "vp"}));
  expect_failure(ErrorCode::bad_value, "--kernel-scale: expected a finite number, got \"nan\"",
                 good({"--kernel-scale", "nan"}));
  expect_failure(ErrorCode::bad_value, "--offset: expected a finite number, got \"inf\"",
                 good({"--offset", "0,inf,0"}));
  expect_failure(ErrorCode::bad_value, "--offset: expected 3 value(s), got 2", good({"--offset", "0,1"}));
  expect_failure(ErrorCode::bad_value, "unexpected argument", good({"another.json"}));
  expect_failure(ErrorCode::bad_value, "--progress", good({"--progress", "always"}));
  expect_failure(ErrorCode::bad_value, "scene: expected a value", {"", "-o", path("out.exr")});
  expect_failure(ErrorCode::bad_value, "none.json", {"--config", path("none.json")});
}

TEST_F(ToolTest, OutOfRange) {
  expect_failure(ErrorCode::out_of_range, "--count: 0 is out of range: expected INT in [1 - 1048576]",
                 good({"--count", "0"}));
  expect_failure(ErrorCode::out_of_range, "--count", good({"--count", "99999999999"}));
  expect_failure(ErrorCode::out_of_range, "--kernel-scale: 0.05 is out of range",
                 good({"--kernel-scale", "0.05"}));
  expect_failure(ErrorCode::out_of_range, "--threads", good({"--threads", "1025"}));
  expect_failure(ErrorCode::out_of_range, "--threads", good({"--threads", "-1"}));
  expect_failure(ErrorCode::out_of_range, "--seed: -1 is out of range", good({"--seed", "-1"}));
  expect_failure(ErrorCode::bad_value, "--seed", good({"--seed", "18446744073709551616"}));
}

TEST_F(ToolTest, MissingAndConflicting) {
  expect_failure(ErrorCode::missing_option, "--output is required", {path("scene.json")});
  expect_failure(ErrorCode::missing_option, "scene is required", {"-o", path("out.exr")});
  expect_failure(ErrorCode::conflicting_options, "--quiet excludes --verbose", good({"-q", "-v"}));
  expect_failure(ErrorCode::conflicting_options, "--sizes excludes --dump", good({"--dump", "--sizes", "3"}));
  expect_failure(ErrorCode::conflicting_options, "is also given as --output",
                 good({"--map", path("out.exr")}));
  expect_failure(ErrorCode::conflicting_options, "is also given as scene",
                 {path("scene.json"), "-o", path("./scene.json"), "--overwrite"});
}

TEST_F(ToolTest, FilesAreCheckedBeforeTheWorkBegins) {
  expect_failure(ErrorCode::file_not_found, "none.json: no such file (scene)",
                 {path("none.json"), "-o", path("out.exr")});
  expect_failure(ErrorCode::file_not_found, "no such file (--rsm)", good({"--rsm", path("none.exr")}));
  expect_failure(ErrorCode::write_failed, "does not exist", {path("scene.json"), "-o", path("none/out.exr")});
  expect_failure(ErrorCode::write_failed, "does not exist", good({"--map", path("none/map.exr")}));
  write("out.exr", "old");
  expect_failure(ErrorCode::output_exists, "--overwrite", good());
  EXPECT_EQ(read("out.exr"), "old");
  EXPECT_EQ(run(good({"--overwrite"})).status, 0);
  EXPECT_EQ(read("out.exr"), "lights");
}

TEST_F(ToolTest, ErrorsOfTheBodyHaveTheirStatusAndLeaveNoFile) {
  const Names before = listing();
  const auto fails_with = [&](const std::function<void()>& thrower, int status, const std::string& message) {
    const Outcome outcome = run(good({"--json"}), [&](Tool&, Report&, OutputSet& outputs) {
      write_text(outputs.add(path("out.exr")), "half");
      thrower();
      return Exit::ok;
    });
    EXPECT_EQ(outcome.status, status);
    EXPECT_EQ(outcome.err, "vsgl-gen: error " + message + "\n");
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(listing(), before);
  };
  fails_with([] { throw Error(ErrorCode::non_finite, "rsm.exr: NaN"); }, 3, "E3006: rsm.exr: NaN");
  fails_with([] { throw Error(ErrorCode::no_device, "none"); }, 5, "E5001: none");
  fails_with([] { throw std::bad_alloc(); }, 4, "E4003: not enough memory; use smaller sizes");
  fails_with([] { throw std::logic_error("oops"); }, 70, "E7001: oops; this is a bug in the tool");
}

TEST_F(ToolTest, DiffersIsAStatusAndKeepsTheOutputs) {
  const Outcome outcome = run(good(), [&](Tool&, Report&, OutputSet& outputs) {
    write_text(outputs.add(path("out.exr")), "map");
    return Exit::differs;
  });
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(read("out.exr"), "map");
}

TEST_F(ToolTest, WarningsGoToStderr) {
  const auto warn = [&](Tool&, Report& report, OutputSet&) {
    report.warn("blended material");
    return Exit::ok;
  };
  EXPECT_EQ(run(good(), warn).err, "vsgl-gen: warning: blended material\n");
  EXPECT_EQ(run(good({"-q"}), warn).err, "");
}

TEST_F(ToolTest, ThreadsAreInForce) {
  const int before = omp_get_max_threads();
  EXPECT_EQ(run(good({"--threads", "3"})).threads, 3);
  omp_set_num_threads(before);
}

TEST_F(ToolTest, ConfigIsOverriddenByFlagsAndOverridesDefaults) {
  const std::string text =
      R"({"scene": "scene.json", "output": "out.exr", "count": 7, "kernel_scale": 2, "offset": [1, 2, 3],
                               "no_skip": true, "overwrite": true, "quiet": false, "verbose": 1})";
  const Outcome config = run_config(text);  // paths are relative to the file's folder
  EXPECT_EQ(config.status, 0) << config.err;
  EXPECT_EQ(config.count, 7);
  EXPECT_EQ(config.provenance.command_line,
            "vsgl-gen --no-skip scene.json --count 7 --kernel-scale 2.0 --offset 1.0,2.0,3.0");
  EXPECT_EQ(run_config(text, {"--count", "9"}).count, 9);
  EXPECT_EQ(run_config(R"({"scene": "scene.json", "output": "out2.exr"})").count, 1024);
}

TEST_F(ToolTest, ConfigErrors) {
  expect_config_failure(ErrorCode::unknown_option,
                        "config.json: /cuont: no such key; did you mean \"count\"?", R"({"cuont": 5})");
  expect_config_failure(ErrorCode::unknown_option, "/config: no such key", R"({"config": "other.json"})");
  expect_config_failure(ErrorCode::unknown_option, "/dry_run: no such key", R"({"dry_run": true})");
  expect_config_failure(ErrorCode::unknown_option,
                        "/kernel-scale: no such key; did you mean \"kernel_scale\"?",
                        R"({"kernel-scale": 1})");
  expect_config_failure(ErrorCode::bad_value, "config.json: /count: expected an integer, got \"5\"",
                        R"({"count": "5"})");
  expect_config_failure(ErrorCode::bad_value, "/count: expected an integer, got 5.5", R"({"count": 5.5})");
  expect_config_failure(ErrorCode::bad_value, "/method: expected a string, got 5", R"({"method": 5})");
  expect_config_failure(ErrorCode::bad_value, "/dump: expected true or false, got 1", R"({"dump": 1})");
  expect_config_failure(ErrorCode::bad_value, "/verbose: expected a count, got true", R"({"verbose": true})");
  expect_config_failure(ErrorCode::bad_value, "/offset: expected an array, got 3", R"({"offset": 3})");
  expect_config_failure(ErrorCode::bad_value, "/scene: expected a string, got null", R"({"scene": null})");
  expect_config_failure(ErrorCode::bad_value, "config.json: parse error at line 1, column 2", "{");
  expect_config_failure(ErrorCode::bad_value, "expected an object", "[]");
  expect_config_failure(ErrorCode::out_of_range, "--count: 0 is out of range", R"({"count": 0})");
  expect_config_failure(ErrorCode::bad_value, "\"x\" is not one of {vpl,fis}", R"({"method": "x"})");
  expect_config_failure(ErrorCode::missing_option, "scene is required", R"({"count": 5})");
}

TEST_F(ToolTest, DryRunPrintsTheResolvedConfigurationAndDoesNothing) {
  const Names before = listing();
  const Outcome dry =
      run(good({"--dry-run", "--count", "12", "--offset", "-1,0,0.5", "--seed", "18446744073709551615"}));
  EXPECT_EQ(dry.status, 0) << dry.err;
  EXPECT_FALSE(dry.worked);
  EXPECT_EQ(listing(), before);
  const Json config = Json::parse(dry.out);
  std::string keys;
  for (const auto& [key, value] : config.items()) keys += key + " ";
  EXPECT_EQ(keys,
            "device threads seed json overwrite if_changed progress quiet verbose no_skip scene output count "
            "kernel_scale method "
            "offset sizes dump ");
  EXPECT_EQ(config["count"], 12);
  EXPECT_EQ(config["offset"], Json::array({-1.0, 0.0, 0.5}));
  EXPECT_EQ(config["sizes"], Json::array({1, 2}));
  EXPECT_EQ(config["seed"].dump(), "18446744073709551615");
  EXPECT_EQ(config["scene"], path("scene.json").string());
}

TEST_F(ToolTest, DryRunRoundTripsThroughAConfig) {
  const Outcome first =
      run(good({"--dry-run", "--kernel-scale", "0.1", "-vv", "--dump", "--rsm", path("a b.exr")}));
  ASSERT_EQ(first.status, 0) << first.err;
  const Outcome second = run_config(first.out, {"--dry-run"});
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
}

TEST_F(ToolTest, ProvenanceNamesInputsByHashAndOnlyFlagsThatShapeTheResult) {
  const Outcome outcome = run(
      good({"--rsm", path("rsm.exr"), "--threads", "2", "--device", "cpu", "--json", "--progress", "never",
            "-v", "--overwrite", "--seed", "5", "--count", "1024", "--sizes", "4,5", "--method", "vpl"}));
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Provenance& provenance = outcome.provenance;
  EXPECT_EQ(provenance.tool, "vsgl-gen");
  EXPECT_EQ(provenance.tool_version, VSGL_VERSION);
  EXPECT_EQ(provenance.command_line, "vsgl-gen --seed 5 scene.json --rsm rsm.exr --method vpl --sizes 4,5");
  EXPECT_EQ(provenance.seed, 5u);
  ASSERT_EQ(provenance.inputs.size(), 2u);
  EXPECT_EQ(provenance.inputs[0].name, "scene.json");
  EXPECT_EQ(provenance.inputs[0].sha256, sha256_file(path("scene.json")));
  EXPECT_EQ(provenance.inputs[1].name, "rsm.exr");
}

TEST_F(ToolTest, ProvenanceHoldsTheFilesThatInputsReferTo) {
  write("mesh.glb", "mesh");
  std::vector<Provenance::Input> inputs;
  run(good(), [&](Tool& tool, Report&, OutputSet&) {
    tool.depends_on(path("mesh.glb"));
    inputs = tool.provenance().inputs;
    return Exit::ok;
  });
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_EQ(inputs[1].name, "mesh.glb");
  EXPECT_EQ(inputs[1].sha256, sha256_file(path("mesh.glb")));
}

TEST_F(ToolTest, ProvenanceQuotesForTheShell) {
  write("it's one.exr", "rsm");
  EXPECT_EQ(run(good({"--rsm", path("it's one.exr")})).provenance.command_line,
            R"(vsgl-gen scene.json --rsm 'it'\''s one.exr')");
}

// For a process of its own: its stdout becomes a device that takes no byte.
[[noreturn]] void ask_for_help_with_a_full_stdout() {
  if (std::freopen("/dev/full", "w", stdout) == nullptr) _exit(99);
  Tool tool("shade", "shades");
  std::string name = "shade", flag = "--help";
  char* argv[] = {name.data(), flag.data()};
  _exit(tool.run(2, argv, [](Report&, OutputSet&) { return Exit::ok; }));
}

TEST(ToolDeathTest, FullStandardOutputIsAnError) {
  EXPECT_EXIT(ask_for_help_with_a_full_stdout(), ::testing::ExitedWithCode(4),
              "shade: error E4001: standard output: writing failed");
}

}  // namespace
}  // namespace vsgl
