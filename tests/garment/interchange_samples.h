#pragma once
/// \file
/// Files of other programs, made in memory: a quad and a pentagon of satin with a pentagon of
/// lining between them, standing in the plane of x and z, in centimetres with z up. UVs are metres.

#include <string>

namespace tsuya::garment::test {

inline const std::string kFbx = R"fbx(; FBX 7.4.0 project file
FBXHeaderExtension:  {
  FBXHeaderVersion: 1003
  FBXVersion: 7400
}
GlobalSettings:  {
  Version: 1000
  Properties70:  {
    P: "UpAxis", "int", "Integer", "",2
    P: "UpAxisSign", "int", "Integer", "",1
    P: "FrontAxis", "int", "Integer", "",1
    P: "FrontAxisSign", "int", "Integer", "",-1
    P: "CoordAxis", "int", "Integer", "",0
    P: "CoordAxisSign", "int", "Integer", "",1
    P: "UnitScaleFactor", "double", "Number", "",1
  }
}
Definitions:  {
  Version: 100
  Count: 3
}
Objects:  {
  Geometry: 1000, "Geometry::cloth", "Mesh" {
    Vertices: *24 {
      a: 0,0,0,50,0,0,50,0,50,0,0,50,100,0,0,100,0,50,125,0,25,75,0,75
    }
    PolygonVertexIndex: *14 {
      a: 0,1,2,-4,1,4,6,5,-3,3,2,5,7,-4
    }
    GeometryVersion: 124
    LayerElementUV: 0 {
      Version: 101
      Name: "pattern"
      MappingInformationType: "ByPolygonVertex"
      ReferenceInformationType: "IndexToDirect"
      UV: *16 {
        a: 0,0,0.5,0,0.5,0.5,0,0.5,1,0,1,0.5,1.25,0.25,0.75,0.75
      }
      UVIndex: *14 {
        a: 0,1,2,3,1,4,6,5,2,3,2,5,7,3
      }
    }
    LayerElementUV: 1 {
      Version: 101
      Name: "light"
      MappingInformationType: "ByPolygonVertex"
      ReferenceInformationType: "IndexToDirect"
      UV: *16 {
        a: 0,0,0.5,0,0.5,0.5,0,0.5,1,0,1,0.5,1.25,0.25,0.75,0.75
      }
      UVIndex: *14 {
        a: 0,1,2,3,1,4,6,5,2,3,2,5,7,3
      }
    }
    LayerElementMaterial: 0 {
      Version: 101
      Name: ""
      MappingInformationType: "ByPolygon"
      ReferenceInformationType: "IndexToDirect"
      Materials: *3 {
        a: 0,1,0
      }
    }
    Layer: 0 {
      Version: 100
      LayerElement:  {
        Type: "LayerElementUV"
        TypedIndex: 0
      }
      LayerElement:  {
        Type: "LayerElementMaterial"
        TypedIndex: 0
      }
    }
    Layer: 1 {
      Version: 100
      LayerElement:  {
        Type: "LayerElementUV"
        TypedIndex: 1
      }
    }
  }
  Model: 2000, "Model::Front", "Mesh" {
    Version: 232
    Properties70:  {
      P: "Lcl Translation", "Lcl Translation", "", "A",0,0,100
    }
  }
  Material: 3000, "Material::satin", "" {
    Version: 102
    ShadingModel: "phong"
  }
  Material: 3001, "Material::lining", "" {
    Version: 102
    ShadingModel: "phong"
  }
}
Connections:  {
  C: "OO",2000,0
  C: "OO",1000,2000
  C: "OO",3000,2000
  C: "OO",3001,2000
}
)fbx";

inline const std::string kCollada = R"dae(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis></asset>
 <library_effects><effect id="e"><profile_COMMON><technique sid="common"><lambert/></technique></profile_COMMON></effect></library_effects>
 <library_materials><material id="m-0" name="satin"><instance_effect url="#e"/></material><material id="m-1" name="lining"><instance_effect url="#e"/></material></library_materials>
 <library_geometries><geometry id="g" name="cloth"><mesh>
  <source id="p"><float_array id="pa" count="24">0 0 0 50 0 0 50 0 50 0 0 50 100 0 0 100 0 50 125 0 25 75 0 75</float_array><technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
  <source id="t"><float_array id="ta" count="16">0 0 0.5 0 0.5 0.5 0 0.5 1 0 1 0.5 1.25 0.25 0.75 0.75</float_array><technique_common><accessor source="#ta" count="8" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <polylist material="m0" count="2"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#t" offset="1" set="0"/><vcount>4 5</vcount><p>0 0 1 1 2 2 3 3 3 3 2 2 5 5 7 7 3 3</p></polylist>
  <polylist material="m1" count="1"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="TEXCOORD" source="#t" offset="1" set="0"/><vcount>5</vcount><p>1 1 4 4 6 6 5 5 2 2</p></polylist>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n-0" name="Front"><translate>0 0 100</translate><instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m0" target="#m-0"/><instance_material symbol="m1" target="#m-1"/></technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
)dae";

} // namespace tsuya::garment::test
