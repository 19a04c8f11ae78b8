#include "exporters/html/write_html.h"

#include <catch2/catch.hpp>

#include "exporters/html/core/reply.h"

using namespace orbc;

namespace {
const std::string kPage = "<script id=\"scene\">\"ORBC-SCENE\"</script><script id=\"assets\">[\"ORBC-ASSETS\"]</script>";
}

TEST_CASE("the page holds the scene where its place is", "[html]") {
  const auto file = html::write_html(kPage, {"orbc: 1\n", {}});
  REQUIRE(file);
  CHECK(file->name.empty());
  CHECK(file->bytes == "<script id=\"scene\">\"orbc: 1\\u000a\"</script><script id=\"assets\">[]</script>");
}

TEST_CASE("names in a scene cannot end the script that holds them", "[html]") {
  const auto file = html::write_html(kPage, {"a: \"</script><script>alert(1)</script>]]>'\"", {{"</script>.obj", {1, 2, 3}}}});
  REQUIRE(file);
  const std::string& page = file->bytes;
  CHECK(page.find("alert") != std::string::npos);
  std::size_t ends = 0;
  for (std::size_t at = page.find("</script>"); at != std::string::npos; at = page.find("</script>", at + 1)) ++ends;
  CHECK(ends == 2);  // the page's own
}

TEST_CASE("a page without a place for a scene is refused", "[html]") { CHECK_FALSE(html::write_html("<html></html>", {"orbc: 1", {}})); }

TEST_CASE("files are deflated and in base64", "[html]") {
  // Three zero bytes as a raw deflate stream of one block with fixed codes.
  const auto file = html::write_html(kPage, {"", {{"m.obj", {0, 0, 0}}}});
  REQUIRE(file);
  CHECK(file->bytes.find("[[\"m.obj\",\"Y2BgAAA=\"]]") != std::string::npos);
}

TEST_CASE("text in a reply is JSON that may stand in HTML", "[html]") {
  CHECK(html::quoted("a\"b\\c\n<&>\x7f") == "\"a\\\"b\\\\c\\u000a\\u003c\\u0026\\u003e\\u007f\"");
}
