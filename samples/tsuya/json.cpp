#include "json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace tsuya::program {

struct JsonWriter {
    using Tree = nlohmann::ordered_json;

    // Bytes that are no UTF-8, as names of files may have, become U+FFFD.
    static std::string text(const Json &json, int indent) {
        return tree(json).dump(indent, ' ', false, Tree::error_handler_t::replace);
    }
    static Tree tree(const Json &json) {
        return std::visit([](const auto &value) { return tree_of(value); }, json.value_);
    }
    static Tree tree_of(const std::vector<Json> &values) {
        Tree list = Tree::array();
        for (const Json &value : values)
            list.push_back(tree(value));
        return list;
    }
    static Tree tree_of(const std::vector<Json::Member> &members) {
        Tree object = Tree::object();
        for (const Json::Member &member : members)
            object[member.key] = tree(member.value);
        return object;
    }
    static Tree tree_of(const auto &value) { return value; }
};

Json::Json(std::initializer_list<Member> members) : value_(Members(members)) {}

Json Json::object() {
    Json json;
    json.value_ = Members();
    return json;
}

Json Json::array(std::initializer_list<Json> values) {
    Json json;
    json.value_ = std::vector<Json>(values);
    return json;
}

Json &Json::operator[](std::string_view key) {
    Members &members = std::get<Members>(value_);
    const auto found = std::find_if(members.begin(), members.end(),
                                    [&](const Member &member) { return member.key == key; });
    return found != members.end() ? found->value
                                  : members.emplace_back(Member{std::string(key), {}}).value;
}

void Json::push_back(Json value) {
    std::get<std::vector<Json>>(value_).push_back(std::move(value));
}

void Json::update(const Json &other) {
    for (const Member &member : std::get<Members>(other.value_))
        (*this)[member.key] = member.value;
}

std::string Json::text() const { return JsonWriter::text(*this, 2); }

std::string Json::one_line() const { return JsonWriter::text(*this, -1); }

} // namespace tsuya::program
