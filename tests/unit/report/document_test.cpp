#include "report/document.h"

#include <gtest/gtest.h>

#include <regex>

#include "report/escape.h"

namespace vsgl::report {
namespace {

const std::string kHostile =
    "</script><script>alert(1)</script><img src=x onerror=alert(1)> \"'& {{script}} ]]> -->";

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

Picture picture(const std::string& label, float value) {
  return {label,
          label,
          2,
          2,
          {{kHostile, {{value, value, value, value}}}},
          {{"tool", kHostile},
           {"inputs",
            "{\"a\":\""
            "b\"}"}}};
}

// Every place that text from outside can reach.
Document document_saying(const std::string& text) {
  Document out;
  out.title = out.summary = out.verdict = text;
  out.failures = {text};
  out.made_by = {text, text, text, 0, {}};
  Images images{picture(text, 1),
                {{picture(text, 2), {{text, text, ErrorMap::Scale::log, 3, 2, 2, {1, 2, 3, 4}}}}},
                0,
                "linear"};
  out.sections = {{text,
                   {Text{text}, Table{text, {text, "b"}, {{text, 1.5}, {nullptr, true}}},
                    Figure{"<svg/>", text, text}, Fragment{text, text}, images},
                   {{text, {}, {}}}}};
  return out;
}

TEST(Escape, LeavesNoMarkup) {
  EXPECT_EQ(escape_html("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
  EXPECT_EQ(escape_html("a\xff"
                        "b\x01"
                        "c\n"),
            "a\xEF\xBF\xBD"
            "b\xEF\xBF\xBD"
            "c\n");
  EXPECT_EQ(escape_html("\xC3\xA4"), "\xC3\xA4");
}

TEST(Escape, JsonCannotEndItsElement) {
  const nlohmann::ordered_json value = {{"</script><!--", "<"}};
  const std::string text = script_json(value);
  EXPECT_EQ(text.find('<'), std::string::npos);
  EXPECT_EQ(nlohmann::ordered_json::parse(text), value);
}

TEST(Escape, Base64) {
  const std::string text = "any carnal pleas";
  EXPECT_EQ(base64(std::as_bytes(std::span(text))), "YW55IGNhcm5hbCBwbGVhcw==");
  EXPECT_EQ(base64({}), "");
}

TEST(Render, TextCannotBecomeMarkup) {
  // Apart from the texts the two pages have the same elements.
  const auto elements = [](const std::string& page) {
    std::vector<std::string> names;
    const std::regex tag("<[a-zA-Z/!][a-zA-Z0-9-]*");
    for (auto it = std::sregex_iterator(page.begin(), page.end(), tag); it != std::sregex_iterator(); ++it)
      names.push_back(it->str());
    return names;
  };
  const std::string hostile = render(document_saying(kHostile)), plain = render(document_saying("plain"));
  EXPECT_EQ(elements(hostile), elements(plain));
  EXPECT_EQ(
      occurrences(hostile, "onerror=alert"),
      occurrences(hostile, "onerror=alert(1)&gt;") + occurrences(hostile, "\\u003cimg src=x onerror=alert"));
}

TEST(Render, EqualDocumentsGiveEqualBytes) {
  EXPECT_EQ(render(document_saying("a")), render(document_saying("a")));
  EXPECT_NE(render(document_saying("a")), render(document_saying("b")));
}

TEST(Render, EqualImagesAreStoredOnce) {
  const auto blobs = [](float second) {
    Document document;
    document.title = "t";
    Images images{picture("b", 1), {{picture("a", 4), {}}, {picture("c", second), {}}}, 0, "linear"};
    document.sections = {{"one", {images}, {}}, {"two", {images}, {}}};
    return occurrences(render(document), "application/octet-stream");
  };
  EXPECT_EQ(blobs(4), 2u);
  EXPECT_EQ(blobs(6), 3u);
}

TEST(Render, FailuresComeFirst) {
  Document document;
  document.title = "t";
  document.verdict = "differs";
  document.passed = false;
  document.failures = {"channel 'x' is off"};
  document.sections = {{"Figures", {}, {}}};
  const std::string page = render(document);
  EXPECT_LT(page.find("channel &#39;x&#39; is off"), page.find("Figures"));
  EXPECT_NE(page.find("verdict failed"), std::string::npos);
  document.passed = true;
  EXPECT_EQ(render(document).find("verdict failed"), std::string::npos);
}

TEST(Render, ForbidsToLoadAnything) {
  const std::string page = render(document_saying("a"));
  EXPECT_NE(page.find("content=\"default-src 'none'; script-src 'sha256-"), std::string::npos);
  for (const char* loader : {"src=\"http", "href=\"http", "@import", "url(", "import("})
    EXPECT_EQ(page.find(loader), std::string::npos) << loader;
}

}  // namespace
}  // namespace vsgl::report
