// What of a description's materials and textures more than one part of the host reads.
#pragma once

#include "LanternHost/SceneDescription.h"
#include "LanternRHI/RTTypes.h"
#include "LanternScene/Scene/Scene.h"

namespace Lantern
{

/// Transmission says more than coverage does, and counts alone.
inline bool IsBlended(const FHostMaterial& Material) { return Material.AlphaMode == EAlphaMode::Blend && Material.Transmission <= 0.0f; }

/// As the scene has it: a map may leave a part that is no metal.
inline bool IsTransmissive(const FHostMaterial& Material)
{
	if (IsBlended(Material)) { return true; }
	return Material.Transmission > 0.0f && (Material.Metallic < 1.0f || Material.Slots[TEXTURE_METALLIC_ROUGHNESS].Texture >= 0);
}

/// Transmission is not cut.
inline bool IsMasked(const FHostMaterial& Material) { return Material.AlphaMode == EAlphaMode::Mask || IsBlended(Material); }

/// Whether the raster tests the alpha of a batch, or of a kind of batches.
template <class T>
bool IsTested(const T& Of, const FSceneFacts& Facts)
{
	return Of.bMasked && (Facts.bMasked || (Of.bBlended && Facts.bTransmissive));
}

/// Without transmission (r.RT.Transmission), a blended surface is cut at half its opacity.
inline float GetAlphaCutoff(const FHostMaterial& Material) { return Material.AlphaMode == EAlphaMode::Blend ? 0.5f : Material.AlphaCutoff; }

/// But for its name.
inline FRTSamplerDesc MakeSamplerDesc(const FHostTexture& Texture)
{
	const auto Address = [](bool bRepeat, bool bMirror) {
		return bMirror ? ERTAddress::Mirror : bRepeat ? ERTAddress::Repeat : ERTAddress::Clamp;
	};
	FRTSamplerDesc Desc;
	Desc.U = Address(Texture.bRepeatU, Texture.bMirrorU);
	Desc.V = Address(Texture.bRepeatV, Texture.bMirrorV);
	if (Texture.bNearest) { Desc.Min = Desc.Mag = ERTFilter::Nearest; }
	return Desc;
}

} // namespace Lantern
