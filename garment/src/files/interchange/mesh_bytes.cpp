#include "files/interchange/mesh_bytes.h"

#include <cstring>
#include <type_traits>

#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

class Writer {
  public:
    template <class T> void operator()(const T &value) {
        if constexpr (std::is_trivially_copyable_v<T>)
            bytes_.append(reinterpret_cast<const char *>(&value), sizeof value);
        else
            fields(*this, value);
    }
    void operator()(const std::string &text) {
        (*this)(text.size());
        bytes_ += text;
    }
    template <class T> void operator()(const std::vector<T> &list) {
        (*this)(list.size());
        if constexpr (std::is_trivially_copyable_v<T>)
            bytes_.append(reinterpret_cast<const char *>(list.data()), list.size() * sizeof(T));
        else
            for (const T &entry : list)
                (*this)(entry);
    }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
};

class Reader {
  public:
    Reader(std::string_view bytes, const std::string &where) : rest_(bytes), where_(where) {}

    template <class T> void operator()(T &value) {
        if constexpr (std::is_trivially_copyable_v<T>)
            std::memcpy(&value, take(sizeof value).data(), sizeof value);
        else
            fields(*this, value);
    }
    void operator()(std::string &text) { text = take(count(1)); }
    template <class T> void operator()(std::vector<T> &list) {
        if constexpr (std::is_trivially_copyable_v<T>) {
            list.resize(count(sizeof(T)));
            if (!list.empty())
                std::memcpy(list.data(), take(list.size() * sizeof(T)).data(),
                            list.size() * sizeof(T));
        } else {
            list.resize(count(1));
            for (T &entry : list)
                (*this)(entry);
        }
    }
    bool at_end() const { return rest_.empty(); }
    [[noreturn]] void fail() const {
        throw Error({"its mesh did not come through", where_, "expected a file that can be read"});
    }

  private:
    std::string_view take(std::size_t size) {
        if (size > rest_.size())
            fail();
        const std::string_view taken = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return taken;
    }
    /// Number of entries, of `size` bytes at least.
    std::size_t count(std::size_t size) {
        std::size_t number = 0;
        (*this)(number);
        if (number > rest_.size() / size)
            fail();
        return number;
    }

    std::string_view rest_;
    const std::string &where_;
};

// The fields, for both directions.
template <class Visit>
void fields(Visit &visit, auto &entry) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(entry)>>, PanelLabel> {
    visit(entry.object);
    visit(entry.group);
    visit(entry.material);
}

template <class Visit>
void fields(Visit &visit, auto &entry) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(entry)>>, Finding> {
    visit(entry.severity);
    visit(entry.key);
    visit(entry.what);
    visit(entry.action);
}

template <class Visit>
void fields(Visit &visit, auto &file) requires
    std::is_same_v<std::remove_const_t<std::remove_reference_t<decltype(file)>>, MeshFile> {
    auto &mesh = file.mesh;
    visit(mesh.position);
    visit(mesh.uv);
    visit(mesh.face_offset);
    visit(mesh.corner_position);
    visit(mesh.corner_uv);
    visit(mesh.face_panel);
    visit(mesh.panel_name);
    visit(mesh.panel_label);
    visit(file.findings);
}

} // namespace

std::string bytes_of(const MeshFile &file) {
    Writer writer;
    writer(file);
    return writer.take();
}

MeshFile mesh_of_bytes(std::string_view bytes, const std::string &where) {
    MeshFile file;
    Reader reader(bytes, where);
    reader(file);
    if (!reader.at_end())
        reader.fail();
    return file;
}

} // namespace tsuya::garment
