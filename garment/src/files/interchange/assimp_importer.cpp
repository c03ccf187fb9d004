// The module: Assimp without any of its steps that change a mesh.

#include <new>
#include <stdexcept>

#include <assimp/DefaultLogger.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include "files/interchange/assimp_scene.h"
#include "files/interchange/importer.h"

namespace tsuya::garment {
namespace {

/// The bytes under one name; no other file can be opened.
class OneFile final : public Assimp::IOSystem {
  public:
    OneFile(std::string_view bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {}
    bool Exists(const char *path) const override { return path == name_; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream *Open(const char *path, const char *) override {
        if (!Exists(path))
            return nullptr;
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t *>(bytes_.data()),
                                          bytes_.size());
    }
    void Close(Assimp::IOStream *stream) override { delete stream; }

  private:
    std::string_view bytes_;
    std::string name_;
};

/// What Assimp warns of.
class Remarks final : public Assimp::LogStream {
  public:
    explicit Remarks(std::vector<std::string> &lines) : lines_(lines) {}
    void write(const char *message) override { lines_.emplace_back(message); }

  private:
    std::vector<std::string> &lines_;
};

/// Files of another content than their extension says are not guessed at.
void keep_importer_of(const std::string &extension, Assimp::Importer &importer) {
    std::vector<Assimp::BaseImporter *> others;
    for (std::size_t i = 0; i < importer.GetImporterCount(); ++i) {
        const std::string known = std::string(" ") + importer.GetImporterInfo(i)->mFileExtensions;
        if ((known + " ").find(" " + extension.substr(1) + " ") == std::string::npos)
            others.push_back(importer.GetImporter(i));
    }
    for (Assimp::BaseImporter *const other : others)
        importer.UnregisterLoader(other);
}

class AssimpImporter final : public Importer {
  public:
    MeshFile read(std::string_view bytes, const std::string &extension) const override {
        std::vector<std::string> remarks;
        Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
        Assimp::DefaultLogger::get()->attachStream(new Remarks(remarks),
                                                   Assimp::Logger::Warn | Assimp::Logger::Err);
        Assimp::Importer importer;
        keep_importer_of(extension, importer);
        importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
        const std::string name = "/mesh" + extension;
        importer.SetIOHandler(new OneFile(bytes, name));
        const aiScene *const scene = importer.ReadFile(name, 0);
        if (!scene && importer.GetErrorString() == std::string("std::bad_alloc"))
            throw std::bad_alloc();
        if (!scene)
            throw std::runtime_error(cause_of(importer.GetErrorString()));
        return mesh_of(*scene, extension, std::move(remarks));
    }
};

} // namespace
} // namespace tsuya::garment

extern "C" [[gnu::visibility("default")]] const tsuya::garment::Importer *tsuya_importer() {
    static const tsuya::garment::AssimpImporter importer;
    return &importer;
}
