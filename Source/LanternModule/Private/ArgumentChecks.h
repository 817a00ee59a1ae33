// What an engine hands over, checked before anything is done with it. Each: Ok, or InvalidArgument saying what is wrong.
#pragma once

#include <array>

#include "LanternModule/Module.h"

namespace Lantern
{

FRTStatus CheckSun(const FRTModuleSun& Sun);
FRTStatus CheckSky(const float Radiance[3]);
FRTStatus CheckSkyProgram(const FRTModuleSkyProgram& Program);
FRTStatus CheckSkyMap(const FRTModuleSkyMap& Map);
FRTStatus CheckLight(const FRTModuleLight& Light);
/// What of a light counts, by its type.
bool HasCone(const FRTModuleLight& Light);
bool NeedsDirection(const FRTModuleLight& Light);
bool NeedsTangent(const FRTModuleLight& Light);
/// Null is fine.
FRTStatus CheckToon(const FRTModuleToon* Toon);
FRTStatus CheckTransform(const double Transform[12]);
FRTStatus CheckMaterial(const FRTModuleMaterial& Material);

inline constexpr size_t MaterialMapCount = 8;
/// In the order of TEXTURE_… in SceneTypes.h.
std::array<const FRTModuleMap*, MaterialMapCount> GetMaps(const FRTModuleMaterial& Material);

/// InvalidArgument, for Reason.
FRTStatus Refuse(const char* Reason);
/// InvalidArgument: Function was given null for Argument.
FRTStatus RefuseNull(const char* Function, const char* Argument);

/// InvalidArgument: Device is null. Unsupported: it has another RHIVersion.
FRTStatus CheckDevice(const char* Function, IRTDevice* Device);

/// InvalidArgument: Function was given a handle of no Kind ("mesh").
FRTStatus RefuseHandle(const char* Function, const char* Kind);

} // namespace Lantern
