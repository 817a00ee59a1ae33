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

/// Declares the G-buffer and what is written.
inline void DeclareLobePixels(FPassBuilder& Builder, const FGBuffer& GBuffer, const FLobePixels& Pixels)
{
	for (const FGraphTexture Texture : {GBuffer.Depth, GBuffer.Normals}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
	Builder.Write(Pixels.Output, ERTAccess::StorageWrite);
	if (!Pixels.Second.IsValid()) { return; }
	for (const FGraphTexture Texture : {GBuffer.BaseColor, GBuffer.Material}) { Builder.Read(Texture, ERTAccess::ShaderRead); }
	Builder.Write(Pixels.Second, ERTAccess::StorageWrite);
}

/// Sets Depth, Normals, BaseColor, Material, Output and SecondOutput of a pass that has declared them.
template <class TConstants>
void SetLobePixels(FPassContext& Pass, const FGBuffer& GBuffer, const FLobePixels& Pixels, TConstants& Out)
{
	const bool bSecond = Pixels.Second.IsValid();
	Out.Depth = GetSampledIndex(Pass, GBuffer.Depth);
	Out.Normals = GetSampledIndex(Pass, GBuffer.Normals);
	Out.BaseColor = GetSampledIndex(Pass, bSecond ? GBuffer.BaseColor : FGraphTexture{});
	Out.Material = GetSampledIndex(Pass, bSecond ? GBuffer.Material : FGraphTexture{});
	Out.Output = GetStorageIndex(Pass, Pixels.Output);
	Out.SecondOutput = GetStorageIndex(Pass, Pixels.Second);
}

} // namespace Lantern
