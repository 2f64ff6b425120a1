// Routes: which pattern answers, what arguments hold, and that no writing of a path reaches what another does not.
#include "trainees/desk/routes/route_table.h"

#include <gtest/gtest.h>

namespace trocar::review::route_table_test {
namespace {

Route route(const std::string& method, const std::string& path) {
  return {.method = method, .path = path, .audience = Audience::kInstructors, .answer = [](const Request&, Desk&) {
            return Response{};
          }};
}

std::string found(const RouteTable& table, const std::string& path, const std::string& method = "GET") {
  const RouteTable::Found found = table.find(method, path);
  return found.route ? found.route->path : "";
}

const RouteTable& sample() {
  static const RouteTable table({route("GET", "/"), route("GET", "/trainee/{code}"), route("POST", "/trainee/{code}"),
                                 route("GET", "/trainee/new"), route("GET", "/trainee/{code}.csv"),
                                 route("GET", "/attempt/{attempt}/frame/{t}.png"), route("POST", "/only-posted")});
  return table;
}

TEST(RouteTable, FindsWordsBeforeArguments) {
  EXPECT_EQ(found(sample(), "/"), "/");
  EXPECT_EQ(found(sample(), "/trainee/T01"), "/trainee/{code}");
  EXPECT_EQ(found(sample(), "/trainee/new"), "/trainee/new");
  EXPECT_EQ(found(sample(), "/trainee/T01.csv"), "/trainee/{code}.csv");
  EXPECT_EQ(found(sample(), "/trainee/.csv"), "/trainee/{code}") << "an argument is never empty";
  EXPECT_EQ(found(sample(), "/trainee/"), "");
  EXPECT_EQ(found(sample(), "/trainee"), "");
  EXPECT_EQ(found(sample(), "/trainee/a/b"), "");
}

TEST(RouteTable, HandsOutArguments) {
  const auto frame = sample().find("GET", "/attempt/0198-ab/frame/12.5.png");
  ASSERT_TRUE(frame.route);
  EXPECT_EQ(frame.arguments.at("attempt"), "0198-ab");
  EXPECT_EQ(frame.arguments.at("t"), "12.5");
  EXPECT_EQ(sample().find("GET", "/trainee/T%2D01").arguments.at("code"), "T-01");
  EXPECT_EQ(sample().find("GET", "/trainee/%2527").arguments.at("code"), "%27") << "decoded once";
}

TEST(RouteTable, TellsMethodsOfAPath) {
  EXPECT_EQ(sample().find("HEAD", "/trainee/T01").route->method, "GET");
  const auto wrong = sample().find("GET", "/only-posted");
  EXPECT_EQ(wrong.route, nullptr);
  EXPECT_EQ(wrong.methods, std::vector<std::string>{"POST"});
  EXPECT_TRUE(sample().find("GET", "/nothing").methods.empty());
  EXPECT_EQ(sample().find("POST", "/trainee/T01").route->method, "POST");
}

TEST(RouteTable, IsNotFooledByWritings) {
  for (const char* path :
       {"/trainee/..", "/trainee/%2e%2e", "/trainee/.%2E", "/trainee/a%2Fb", "/trainee/a%5cb", "/trainee/a\\b",
        "/trainee/%00", "/trainee/a%0d%0ab", "/trainee/%", "/trainee/%ff", "//trainee/T01", "/trainee//T01",
        "/./trainee/T01", "trainee/T01", "", "/trainee/%252e%252e/../x"}) {
    EXPECT_EQ(found(sample(), path), "") << path;
  }
  EXPECT_EQ(found(sample(), "/tr%61inee/T01"), "/trainee/{code}") << "the same path written otherwise is the same page";
}

TEST(RouteTable, RefusesBadPatterns) {
  for (const char* path : {"", "no-slash", "/{}", "/{a", "/a}", "/{a}{b}", "/}{"}) {
    EXPECT_THROW(RouteTable({route("GET", path)}), std::logic_error) << path;
  }
  EXPECT_THROW(RouteTable({route("PUT", "/a")}), std::logic_error);
  EXPECT_THROW(RouteTable({route("GET", "/a"), route("GET", "/a")}), std::logic_error);
  EXPECT_NO_THROW(RouteTable({route("GET", "/a"), route("POST", "/a")}));
  Route empty = route("GET", "/a");
  empty.answer = {};
  EXPECT_THROW(RouteTable({empty}), std::logic_error);
}

}  // namespace
}  // namespace trocar::review::route_table_test
