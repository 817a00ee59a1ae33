// The textures that hold what lobes of pixels receive, for passes that light pixels by what rays have found for several of them.
#pragma once

#include "PassTools.h"

namespace Lantern
{

struct FLobePixels
{
	FGraphTexture Output; ///< of a white Lambert lobe
	FGraphTexture Second; ///< of the second lobe; invalid: there is none
};

/// Whether what a pixel reflects counts, beside where it is.
inline bool ReadsSurface(const FGBuffer& GBuffer, const FLobePixels& Pixels)
{
	return Pixels.Second.IsValid() || GBuffer.BackAlbedo.IsValid();
}

/// Declares the G-buffer and what is written.
inline void DeclareLobePixels(FPassBuilder& Builder, const FGBuffer& GBuffer, const FLobePixels& Pixels)
{
	for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
	Builder.Write(Pixels.Output, ERTAccess::StorageWrite);
	if (Pixels.Second.IsValid()) { Builder.Write(Pixels.Second, ERTAccess::StorageWrite); }
	if (GBuffer.BackAlbedo.IsValid()) { Builder.Read(GBuffer.BackAlbedo, ERTAccess::ShaderRead); }
	if (!ReadsSurface(GBuffer, Pixels)) { return; }
	for (const FGraphTexture Texture : {GBuffer.BaseColor, GBuffer.Material}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
}

/// Sets Depth, Normals, BaseColor, Material, Output and SecondOutput of a pass that has declared them.
template <class TConstants>
void SetLobePixels(FPassContext& Pass, const FGBuffer& GBuffer, const FLobePixels& Pixels, TConstants& Out)
{
	const bool bSurface = ReadsSurface(GBuffer, Pixels);
	Out.Depth = GetSampledIndex(Pass, GBuffer.Depth);
	Out.Normals = GetSampledIndex(Pass, GBuffer.Normals);
	Out.BaseColor = GetSampledIndex(Pass, bSurface ? GBuffer.BaseColor : FGraphTexture{});
	Out.Material = GetSampledIndex(Pass, bSurface ? GBuffer.Material : FGraphTexture{});
	Out.Output = GetStorageIndex(Pass, Pixels.Output);
	Out.SecondOutput = GetStorageIndex(Pass, Pixels.Second);
}

} // namespace Lantern
