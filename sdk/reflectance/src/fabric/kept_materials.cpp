#include "tsuya/sdk/kept_materials.h"

#include "fabric/table_files.h"
#include "tsuya/sdk/detail/fabric_fields.h"
#include "tsuya/sdk/widened_material.h"

namespace tsuya {
namespace {

std::uint64_t hash_of(const Specular &specular, int salt) {
    detail::FieldHasher hasher;
    hasher.add(salt);
    hasher.add(specular);
    return hasher.result();
}

} // namespace

Material KeptMaterials::resolve(const Fabric &fabric, const std::string &where,
                                const Progress &progress) {
    if (!reflects(fabric.specular))
        return tsuya::resolve(fabric, where, progress);
    const Key key{hash_of(fabric.specular, 0), hash_of(fabric.specular, 1)};
    const auto known = kept_.find(key);
    ModelTables tables = known == kept_.end() ? ModelTables{} : known->second;
    if (known != kept_.end())
        ++use_.shared;
    else if (read_tables(cache_, key, tables))
        ++use_.read;
    const ModelTables before = tables;
    Material made = tsuya::resolve(fabric, where, tables, progress);
    kept_[key] = tables;
    if (tables != before) {
        ++use_.made;
        write_tables(cache_, key, tables, use_.cache_problem);
    }
    return made;
}

std::optional<Material> KeptMaterials::widened(const Fabric &fabric, const Material &material,
                                               const Progress &progress) {
    if (!reflects(fabric.specular))
        return std::nullopt;
    const Key key{hash_of(fabric.specular, 0), hash_of(fabric.specular, 1)};
    ModelTables &tables = kept_[key];
    const ModelTables before = tables;
    std::optional<Material> made = tsuya::widened(material, tables, progress);
    if (tables != before)
        write_tables(cache_, key, tables, use_.cache_problem);
    return made;
}

} // namespace tsuya
