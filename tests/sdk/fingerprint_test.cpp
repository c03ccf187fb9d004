// Every field of a scene and of the settings of a render is changed in turn: what changes the
// picture changes the fingerprint, and a render is not resumed with it.

#include <atomic>
#include <iostream>

#include <gtest/gtest.h>

#include "film.h"
#include "sdk/render_scenes.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/detail/scene_fields.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

using detail::Field;

// Changes one of the places where fields can be changed, counted in the order of each_field.
class Change {
  public:
    explicit Change(int place) : rest_(place) {}
    bool done() const { return rest_ < 0; }
    const std::string &path() const { return changed_; }
    bool in_picture() const { return changed_in_picture_; }

    template <class T> void operator()(const Field &field, T &value) {
        const std::string before = path_;
        const bool was_in_picture = in_picture_;
        path_ += "." + std::string(field.key);
        in_picture_ = in_picture_ && field.in_picture;
        visit(value);
        path_ = before;
        in_picture_ = was_in_picture;
    }

  private:
    // Whether it is the turn of this place.
    bool here(const char *how) {
        if (rest_-- != 0)
            return false;
        changed_ = path_ + ": " + how;
        changed_in_picture_ = in_picture_;
        return true;
    }

    template <class T> void visit(T &value) {
        if constexpr (std::is_same_v<T, bool>) {
            if (here("turned"))
                value = !value;
        } else if constexpr (std::is_enum_v<T>) {
            if (here("next"))
                value = static_cast<T>(static_cast<int>(value) + 1);
        } else if constexpr (std::is_arithmetic_v<T>) {
            if (here("more"))
                value = static_cast<T>(value + static_cast<T>(1));
        } else {
            each_field(*this, value);
        }
    }
    template <glm::length_t N, class T, glm::qualifier Q> void visit(glm::vec<N, T, Q> &v) {
        for (glm::length_t i = 0; i < N; ++i)
            visit(v[i]);
    }
    void visit(std::string &text) {
        if (here("longer"))
            text += "x";
    }
    void visit(std::filesystem::path &path) {
        if (here("other"))
            path += "x";
    }
    void visit(std::monostate &) {}
    template <class T> void visit(std::optional<T> &value) {
        if (here("there or not")) {
            if (value)
                value.reset();
            else
                value.emplace();
        } else if (value) {
            visit(*value);
        }
    }
    void visit(Specular &specular) {
        if (here("of another kind"))
            specular = std::holds_alternative<YarnLobes>(specular) ? Specular(GgxFacets{})
                                                                   : Specular(YarnLobes{});
        else
            std::visit([&](auto &kind) { visit(kind); }, specular);
    }
    void visit(Light &light) {
        if (here("of another kind"))
            light =
                std::holds_alternative<SunLight>(light) ? Light(DiskLight{}) : Light(SunLight{});
        else
            std::visit([&](auto &kind) { visit(kind); }, light);
    }
    template <class T> void visit(std::vector<T> &values) {
        if (here("one more"))
            values.emplace_back();
        else
            for (std::size_t i = 0; i < values.size();
                 i += std::max<std::size_t>(1, values.size() / 8))
                visit(values[i]);
    }
    template <class T, std::size_t N> void visit(std::array<T, N> &values) {
        visit(values.front());
        visit(values.back());
    }
    void visit(std::map<std::string, std::string> &texts) {
        if (here("one more"))
            texts["x"] = "y";
    }
    // A BARD has no fields to be set: it is fitted to something else.
    void visit(Bard &bard) {
        ReflectanceTable table{.symmetry = bard.symmetry()};
        for (const BardView &v : bard.views())
            table.rows.push_back({0, 0, v.theta, v.phi, v.brdf_per_sr, v.sigma_per_sr});
        BardSmoothness smoothness = bard.smoothness();
        bool changed = true;
        if (here("of another symmetry"))
            table.symmetry = Symmetry::half_turn;
        else if (here("smoother"))
            smoothness.weft_support *= 1.1;
        else if (here("another value"))
            table.rows[1].brdf_per_sr *= 1.01;
        else if (here("another standard error"))
            table.rows[1].sigma_per_sr += 1e-6;
        else
            changed = false;
        if (changed)
            bard = Bard::fit(table, smoothness, "changed");
    }

    int rest_;
    std::string path_{}, changed_{};
    bool in_picture_ = true, changed_in_picture_ = true;
};

// A scene that has everything: every kind of fabric and light, a picture of the environment.
Scene full_scene() {
    Scene scene = folded_satin(40, 40);
    scene.fabrics[0].colours.weft_tint = Spectrum::constant(0.5);
    scene.fabrics[0].keys["instrument"] = "made up";
    scene.fabrics[0].spare = {GgxFacets{}};
    scene.fabrics[0].weave = ClothWeave{
        .preset = "plain",
        .map = {.repeat = {1, 1}, .size = {1, 1}, .threads = {1, 1}, .place = {WeavePlace{}}}};
    YarnLobes lobes;
    lobes.surface[0][24] = 0.5;
    const ReflectanceTable table = paper_table(satin_cloth(), 30, 90);
    for (const Specular &specular :
         {Specular(lobes), Specular(GgxFacets{.refractive_index = 1.5}),
          Specular(TabulatedSpecular{.table = table, .file = "table.csv"})})
        scene.fabrics.push_back({.name = "cloth", .specular = specular});
    scene.environment->picture = Image::make(2, 1, {"L"});
    scene.environment->picture->data = {1, 2};
    scene.lights.insert(scene.lights.end(),
                        {DiskLight{}, SphereLight{},
                         PointLight{.full_angle = 0.2, .cone_angle = 0.5},
                         PointLight{.profile = IntensityProfile{{0, 1}, {0}, {1, 1}}}, SunLight{}});
    scene.surfaces[1].uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    scene.textures = {{.width = 2, .height = 1, .channels = 1, .data = {10, 200}},
                      {.width = 2, .height = 1, .channels = 1, .data = {20, 100}}};
    scene.prints = {{.layers = {{{0}, {Spectrum::constant(0.5)}}}}};
    scene.opacities = {{.picture = {1}}};
    scene.objects[1].print = PrintIndex{0};
    scene.objects[1].panels = {{.panel = 0,
                                .fabric = {1},
                                .back = FabricIndex{1},
                                .print = PrintIndex{0},
                                .back_print = PrintIndex{0},
                                .opacity = OpacityIndex{0}}};
    return scene;
}

RenderSettings full_settings() {
    RenderSettings settings = quick(24);
    settings.aovs = {"depth"};
    settings.crop = {0, 0, 32, 32};
    settings.checkpoint = std::filesystem::path(testing::TempDir()) / "tsuya-fields.checkpoint";
    return settings;
}

TEST(Fingerprint, KnowsEveryFieldThatChangesThePicture) {
    const Scene scene = full_scene();
    RenderSettings settings = full_settings();
    std::atomic<bool> stop{false};
    render(scene, settings,
           {.report = [&](std::string_view stage,
                          double done) { stop = stage == "render" && done > 0.4; },
            .stop = &stop});
    ASSERT_TRUE(std::filesystem::exists(settings.checkpoint));
    settings.resume = true;
    const tsuya::detail::Fingerprint print = fingerprint(scene, settings);
    EXPECT_EQ(fingerprint(full_scene(), settings), print);
    int refused = 0, free = 0;
    for (int place = 0;; ++place) {
        Scene other = scene;
        RenderSettings others = settings;
        Change change(place);
        each_field(change, other);
        each_field(change, others);
        if (!change.done())
            break;
        EXPECT_EQ(fingerprint(other, others) != print, change.in_picture()) << change.path();
        if (!change.in_picture()) {
            ++free;
            continue;
        }
        try {
            render(other, others);
            ADD_FAILURE() << change.path() << " was accepted";
        } catch (const Error &error) { // of the checkpoint, or of a scene that is none any more
            refused += error.problems()[0].where == settings.checkpoint.string() ? 1 : 0;
        }
    }
    std::cout << refused << " changes were refused by the checkpoint, " << free << " are free\n";
    EXPECT_GT(refused, 150);
    EXPECT_GT(free, 15);
    std::filesystem::remove(settings.checkpoint);
}

// A picture of 2 x 1 has the values of one of 1 x 2; a table that is half a turn the same is
// another reflectance.
TEST(Fingerprint, TellsApartWhatHasTheSameNumbers) {
    const RenderSettings settings = full_settings();
    Scene flat = full_scene(), tall = flat, turned = flat;
    std::swap(tall.environment->picture->width, tall.environment->picture->height);
    std::get<TabulatedSpecular>(turned.fabrics.back().specular).table.symmetry =
        Symmetry::half_turn;
    const tsuya::detail::Fingerprint print = fingerprint(flat, settings);
    EXPECT_NE(fingerprint(tall, settings), print);
    EXPECT_NE(fingerprint(turned, settings), print);
}

} // namespace
} // namespace tsuya::test
