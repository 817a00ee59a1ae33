// Hashes everything of a scene that pictures depend on.
#include "LanternHost/SceneHash.h"

#include <cassert>
#include <cstdio>
#include <vector>

#include <xxhash.h>

namespace Lantern
{

std::string FContentHash::ToHex() const
{
	char Text[33];
	std::snprintf(Text, sizeof(Text), "%016llx%016llx", static_cast<unsigned long long>(High), static_cast<unsigned long long>(Low));
	return Text;
}

struct FContentHasher::FState
{
	FState() : Xxh(XXH3_createState())
	{
		assert(Xxh && "out of memory");
		XXH3_128bits_reset(Xxh);
	}
	~FState() { XXH3_freeState(Xxh); }
	FState(const FState&) = delete;
	FState& operator=(const FState&) = delete;

	XXH3_state_t* Xxh;
};

FContentHasher::FContentHasher() : State(std::make_unique<FState>()) {}
FContentHasher::~FContentHasher() = default;

void FContentHasher::AddBytes(const void* Data, size_t Size)
{
	if (Size > 0) { XXH3_128bits_update(State->Xxh, Data, Size); }
}

void FContentHasher::AddText(std::string_view Text)
{
	Add(static_cast<uint64_t>(Text.size()));
	AddBytes(Text.data(), Text.size());
}

FContentHash FContentHasher::Finish() const
{
	const XXH128_hash_t Hash = XXH3_128bits_digest(State->Xxh);
	return {Hash.low64, Hash.high64};
}

namespace
{
/// One overload for each type of a description. Each adds the members that affect pictures.
class FSceneHasher
{
public:
	template <class T>
	void AddList(const std::vector<T>& List)
	{
		Hash.Add(static_cast<uint64_t>(List.size()));
		for (const T& Item : List) { Add(Item); }
	}
	/// Adds all values at once; T must have no padding.
	template <class T>
	void AddPlain(const std::vector<T>& List)
	{
		static_assert(std::is_trivially_copyable_v<T>);
		Hash.Add(static_cast<uint64_t>(List.size()));
		Hash.AddBytes(List.data(), List.size() * sizeof(T));
	}
	template <class T>
	void AddOptional(const std::optional<T>& Value)
	{
		Hash.Add(Value.has_value());
		if (Value) { AddFloats(*Value); }
	}
	/// Vectors, quaternions and matrices.
	template <class T>
	void AddFloats(const T& Value)
	{
		static_assert(sizeof(T) % sizeof(typename T::value_type) == 0);
		Hash.AddBytes(&Value, sizeof(Value));
	}
	template <class... T>
	void AddAll(const T&... Values)
	{
		(Hash.Add(Values), ...);
	}

	void Add(const FHostImage& V)
	{
		AddAll(V.Width, V.Height, V.bSrgb, V.bHasAlpha);
		AddPlain(V.Rgba);
	}
	void Add(const FHostTexture& V) { AddAll(V.Image, V.bRepeatU, V.bRepeatV, V.bMirrorU, V.bMirrorV, V.bNearest); }
	void Add(const FHostTextureSlot& V)
	{
		AddAll(V.Texture, V.UVSet);
		AddFloats(V.Transform);
		AddFloats(V.Offset);
	}
	void Add(const FHostMaterial& V)
	{
		AddFloats(V.BaseColor);
		AddFloats(V.Emissive);
		if (V.LightEmissive) { AddFloats(*V.LightEmissive); }
		AddAll(V.Metallic, V.Roughness, V.NormalScale, V.OcclusionStrength, V.AlphaCutoff, V.Ior, V.Specular, V.Transmission, V.AlphaMode,
		    V.bDoubleSided, V.bSolid);
		AddFloats(V.Extinction);
		if (V.ScatterAlbedo != glm::vec3(0))
		{
			AddFloats(V.ScatterAlbedo);
			AddAll(V.ScatterAnisotropy);
		}
		if (V.DiffuseTransmission > 0.0f)
		{
			AddAll(V.DiffuseTransmission);
			AddFloats(V.DiffuseTransmissionColor);
		}
		for (uint32_t Slot = 0; Slot < TEXTURE_SLOTS; ++Slot)
		{
			if (Slot < TEXTURE_DIFFUSE_TRANSMISSION || V.DiffuseTransmission > 0.0f) { Add(V.Slots[Slot]); }
		}
		Hash.AddText(V.Program);
	}
	void Add(const FHostSection& V) { AddAll(V.FirstIndex, V.IndexCount, V.Material); }
	void Add(const FSkinWeights& V)
	{
		Hash.AddBytes(V.Joints.data(), sizeof(V.Joints));
		Hash.AddBytes(V.Weights.data(), sizeof(V.Weights));
	}
	void Add(const FHostMesh& V)
	{
		AddPlain(V.Positions);
		AddPlain(V.Attributes);
		AddList(V.Skin);
		AddPlain(V.Indices);
		AddList(V.Sections);
		Hash.Add(V.bHasTangents);
	}
	void Add(const FHostNode& V)
	{
		Hash.Add(V.Parent);
		AddFloats(V.Translation);
		AddFloats(V.Rotation);
		AddFloats(V.Scale);
		AddOptional(V.Matrix);
		AddAll(V.Mesh, V.Skin, V.Light, V.Camera);
		if (V.Traits != FRTObjectTraits())
		{
			Hash.Add(MakeObjectMask(V.Traits) | (V.Traits.bCharacter ? 256u : 0u) | (uint32_t(V.Traits.Channels ^ CHANNELS_DEFAULT) << 9));
		}
		AddPlain(V.Materials);
		if (V.Toon) { AddToon(*V.Toon); }
	}
	void AddToon(const FToonStyle& V)
	{
		AddFloats(V.Center);
		AddFloats(V.Tint);
		AddAll(V.SphereWeight, V.Bend, V.MaxSaturation, V.MaxValue, V.Occlusion, V.Number);
	}
	void Add(const FHostSkin& V)
	{
		AddPlain(V.Joints);
		AddPlain(V.InverseBind);
	}
	void Add(const FHostChannel& V)
	{
		AddAll(V.Node, V.Path, V.Interpolation);
		AddPlain(V.Times);
		AddPlain(V.Values);
	}
	void Add(const FHostAnimation& V)
	{
		AddList(V.Channels);
		Hash.Add(V.Duration);
	}
	void Add(const FHostLight& V)
	{
		Hash.Add(V.Type);
		AddFloats(V.Color);
		AddAll(V.Range, V.InnerCone, V.OuterCone, V.bCastsShadow, V.bTwoSided);
		AddFloats(V.Size);
		if (V.Profile != 0 || V.Channels != CHANNELS_DEFAULT) { AddAll(V.Profile, V.Channels); }
		if (V.FlickerHz > 0.0f) { AddAll(V.FlickerHz, V.FlickerDuty, V.FlickerPhase); }
	}
	void Add(const FProfileGrid& V)
	{
		AddPlain(V.Texels);
		AddAll(V.Rows, V.Columns, V.FirstAngle, V.RowsPerDegree, V.ColumnsPerDegree);
	}

	FContentHasher Hash;
};
static_assert(sizeof(FVertexAttributes) == 28, "hashed as bytes: no padding");
} // namespace

FContentHash HashScene(const FSceneDescription& Scene)
{
	FSceneHasher Hasher;
	Hasher.AddList(Scene.Images);
	Hasher.AddList(Scene.Textures);
	Hasher.AddList(Scene.Materials);
	Hasher.AddList(Scene.Meshes);
	Hasher.AddList(Scene.Nodes);
	Hasher.AddList(Scene.Skins);
	Hasher.AddList(Scene.Animations);
	Hasher.AddList(Scene.Lights);
	if (!Scene.Profiles.empty()) { Hasher.AddList(Scene.Profiles); }
	return Hasher.Hash.Finish();
}

} // namespace Lantern
