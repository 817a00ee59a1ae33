// FSceneCalls: objects, lights and sky. SceneCallsMeshes.cpp has meshes, SceneCallsMaterials.cpp materials.
#include "SceneCalls.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <utility>

#include "ArgumentChecks.h"
#include "LanternRHI/RTText.h"

namespace Lantern
{

namespace
{

uint32_t ToLightType(ERTModuleLight Type)
{
	switch (Type)
	{
	case ERTModuleLight::Point:
	case ERTModuleLight::Spot: return LIGHT_POINT;
	case ERTModuleLight::Directional: return LIGHT_DIRECTIONAL;
	case ERTModuleLight::Rectangle: return LIGHT_RECTANGLE;
	case ERTModuleLight::Disk: return LIGHT_DISK;
	case ERTModuleLight::Sphere: return LIGHT_SPHERE;
	case ERTModuleLight::Tube: return LIGHT_TUBE;
	}
	return LIGHT_NONE;
}

glm::vec2 ToLightSize(const FModuleWorld& World, const FRTModuleLight& From)
{
	const auto Metres = [&World](float Length) { return static_cast<float>(World.ToMeters(double(Length))); };
	switch (From.Type)
	{
	case ERTModuleLight::Directional: return {From.AngularDiameter, 0.0f};
	case ERTModuleLight::Rectangle: return {Metres(From.Width), Metres(From.Height)};
	case ERTModuleLight::Disk:
	case ERTModuleLight::Sphere: return {Metres(From.Radius), 0.0f};
	case ERTModuleLight::Tube: return {Metres(From.Radius), Metres(From.Length)};
	default: return glm::vec2(0);
	}
}

/// From: checked.
FSceneLight ToSceneLight(const FModuleWorld& World, const FRTModuleLight& From, ERTLightHandle Handle)
{
	FSceneLight Light;
	Light.Type = ToLightType(From.Type);
	Light.Position = World.ToPosition(From.Position);
	if (NeedsDirection(From)) { Light.Direction = glm::vec3(normalize(World.ToDirection(From.Direction))); }
	if (NeedsTangent(From)) { Light.Tangent = glm::vec3(normalize(World.ToDirection(From.Tangent))); }
	Light.Color = {From.Color[0], From.Color[1], From.Color[2]};
	Light.Range = static_cast<float>(World.ToMeters(double(From.Range)));
	if (HasCone(From))
	{
		Light.InnerCone = From.InnerCone;
		Light.OuterCone = From.OuterCone;
	}
	Light.Size = ToLightSize(World, From);
	Light.bCastsShadow = From.bCastsShadow;
	Light.bTwoSided = From.bTwoSided;
	Light.bLightsFog = From.bLightsFog;
	Light.Channels = From.Channels;
	if (From.Ies != ERTIesHandle::None) { Light.Profile = TSlotTable<int, ERTIesHandle>::GetSlot(From.Ies) + 1; }
	Light.Number = GetLightNumber(Handle);
	return Light;
}

/// Reads the file, or checks the table.
FRTStatus ReadProfile(const FRTModuleIesProfile& Profile, FPhotometry& Out)
{
	const char* const Name = Profile.Name != nullptr ? Profile.Name : "IES profile";
	if (Profile.Text != nullptr) { return ParseIes({Profile.Text, static_cast<size_t>(Profile.TextBytes)}, Name, Out); }
	if (Profile.VerticalAngles == nullptr || Profile.HorizontalAngles == nullptr || Profile.Candela == nullptr)
	{
		return RefuseNull("AddIesProfile", "Text, and a part of the table");
	}
	constexpr uint32_t MostAngles = 4096; // a tenth of a degree needs 3,601
	for (const auto& [Given, Member] : {std::pair(Profile.VerticalCount, "VerticalCount"), {Profile.HorizontalCount, "HorizontalCount"}})
	{
		if (Given <= MostAngles) { continue; }
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleIesProfile::%s must be %u at most, is %u", Member, MostAngles, Given);
	}
	const uint64_t Count = uint64_t(Profile.VerticalCount) * Profile.HorizontalCount;
	Out.Vertical.assign(Profile.VerticalAngles, Profile.VerticalAngles + Profile.VerticalCount);
	Out.Horizontal.assign(Profile.HorizontalAngles, Profile.HorizontalAngles + Profile.HorizontalCount);
	Out.Candela.assign(Profile.Candela, Profile.Candela + Count);
	return CheckPhotometry(Out, Name);
}

uint32_t MakeTag()
{
	static std::atomic<uint32_t> Count{0};
	return Count++ % TSlotTable<int, ERTMeshHandle>::MaxTag + 1;
}

} // namespace

FSceneCalls::FSceneCalls(IRTDevice& InDevice, const FModuleWorld& InWorld, FBufferUploads& InUploads)
    : World(InWorld),
      Device(&InDevice),
      Uploads(&InUploads),
      Tag(MakeTag())
{}

// ---------------------------------------------------------------------------------------------------- commands

FSceneCalls::FTicket FSceneCalls::AddArrival(FSceneCommand Command)
{
	Arrivals.push_back(std::move(Command));
	return ++LastArrival;
}

void FSceneCalls::AddUpdate(FSceneCommand Command, FTicket Needs, FTicket& InOutTicket)
{
	if (std::max(Needs, InOutTicket) <= LastTaken) { Updates.push_back(std::move(Command)); }
	else { InOutTicket = AddArrival(std::move(Command)); }
}

size_t FSceneCalls::CountArrivals(uint32_t Most) const
{
	constexpr uint32_t MeshWeight = 4; // the store takes a mesh in, which takes several times as long as placing an object
	uint32_t Weight = 0;
	size_t Count = 0;
	for (; Count < Arrivals.size(); ++Count)
	{
		Weight += std::holds_alternative<FAddMeshCommand>(Arrivals[Count]) ? MeshWeight : 1;
		if (Weight > Most && Count > 0) { break; }
	}
	return Count;
}

bool FSceneCalls::Take(uint32_t MostArrivals, std::vector<FSceneCommand>& Out)
{
	std::lock_guard Lock(Mutex);
	// Updates concern what the scene has already, so that arrivals cannot be what they wait for.
	std::move(Updates.begin(), Updates.end(), std::back_inserter(Out));
	Updates.clear();
	const size_t Count = MostArrivals > 0 ? CountArrivals(MostArrivals) : Arrivals.size();
	const auto End = Arrivals.begin() + static_cast<ptrdiff_t>(Count);
	std::move(Arrivals.begin(), End, std::back_inserter(Out));
	Arrivals.erase(Arrivals.begin(), End);
	LastTaken += Count;
	return !Arrivals.empty();
}

// ---------------------------------------------------------------------------------------------------- objects

namespace
{
/// Toon: null, or checked.
std::shared_ptr<const FToonStyle> ToToonStyle(const FRTModuleToon* Toon)
{
	if (Toon == nullptr) { return nullptr; }
	FToonStyle Style;
	Style.Center = {Toon->Center[0], Toon->Center[1], Toon->Center[2]};
	Style.SphereWeight = Toon->SphereWeight;
	Style.Bend = Toon->Bend;
	Style.MaxSaturation = Toon->MaxSaturation;
	Style.MaxValue = Toon->MaxValue;
	Style.Occlusion = Toon->Occlusion;
	Style.Tint = {Toon->Tint[0], Toon->Tint[1], Toon->Tint[2]};
	Style.Number = Toon->Number;
	return std::make_shared<const FToonStyle>(Style);
}
} // namespace

FRTStatus FSceneCalls::CheckObject(const FRTModuleObject& Object)
{
	const FMesh* const Mesh = Meshes.Find(Object.Mesh);
	if (Mesh == nullptr) { return RefuseMesh("AddObject", Object.Mesh); }
	if (Object.Mobility > ERTModuleMobility::Movable)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "FRTModuleObject::Mobility is none");
	}
	if (const FRTStatus Status = CheckToon(Object.Toon); !Status) { return Status; }
	const FRTStatus Status = CheckTransform(Object.Transform);
	return Status ? CheckMaterials(*Mesh, Object.Materials, Object.MaterialCount) : Status;
}

ERTObjectHandle FSceneCalls::AddOne(const FRTModuleObject& Object)
{
	FObject Added;
	Added.Mesh = Object.Mesh;
	Added.Materials.assign(Object.Materials, Object.Materials + Object.MaterialCount);
	Added.Traits = {Object.bVisible, Object.bCastsShadow, Object.bCastsLocalShadow, Object.Mobility == ERTModuleMobility::Movable,
	    Object.bCharacter, Object.Channels};
	Added.Toon = ToToonStyle(Object.Toon);
	Added.Mobility = Object.Mobility;
	AddUsers(Added);
	++Meshes.Find(Object.Mesh)->Users;
	++ObjectCount;
	FAddObjectCommand Command;
	Command.Mesh = Meshes.GetSlot(Object.Mesh);
	Command.Materials = GetSlots(Added.Materials);
	Command.Mask = MakeObjectMask(Added.Traits);
	Command.bCharacter = Added.Traits.bCharacter;
	Command.Channels = Added.Traits.Channels;
	Command.Toon = Added.Toon;
	Command.Transform = World.ToTransform(Object.Transform);
	const ERTObjectHandle Handle = Objects.Add(std::move(Added));
	Command.Slot = Objects.GetSlot(Handle);
	const FTicket Ticket = AddArrival(std::move(Command));
	Objects.Find(Handle)->Ticket = Ticket;
	return Handle;
}

FRTStatus FSceneCalls::AddObjects(const FRTModuleObject* Added, uint32_t Count, ERTObjectHandle* Out)
{
	if (Count > 0 && Added == nullptr) { return RefuseNull("AddObjects", "Objects"); }
	if (Count > 0 && Out == nullptr) { return RefuseNull("AddObjects", "Out"); }
	std::fill_n(Out, Count, ERTObjectHandle::None);
	std::lock_guard Lock(Mutex);
	for (uint32_t I = 0; I < Count; ++I)
	{
		const FRTStatus Status = CheckObject(Added[I]);
		if (Status) { continue; }
		return Count == 1 ? Status : FRTStatus::Error(Status.Code, "object %u: %s", I, Status.Message);
	}
	if (Count > uint64_t(MaxInstanceIndex) + 1 - ObjectCount)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "AddObject: the scene has as many objects as instances can name");
	}
	std::transform(Added, Added + Count, Out, [this](const FRTModuleObject& Object) { return AddOne(Object); });
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetObjectTransform(ERTObjectHandle Handle, const double Transform[12])
{
	const FRTStatus Status = CheckTransform(Transform);
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectTransform", "object"); }
	if (Object->Mobility != ERTModuleMobility::Movable)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "SetObjectTransform: the object's Mobility is not Movable");
	}
	if (Status) { AddUpdate(FTransformCommand{Objects.GetSlot(Handle), World.ToTransform(Transform)}, 0, Object->Ticket); }
	return Status;
}

FRTStatus FSceneCalls::SetMask(const char* Function, ERTObjectHandle Handle, bool FRTObjectTraits::*Member, bool bValue)
{
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle(Function, "object"); }
	Object->Traits.*Member = bValue;
	AddUpdate(FMaskCommand{Objects.GetSlot(Handle), MakeObjectMask(Object->Traits)}, 0, Object->Ticket);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetObjectMesh(ERTObjectHandle Handle, ERTMeshHandle Mesh, const ERTMaterialHandle* Handles, uint32_t Count)
{
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectMesh", "object"); }
	FMesh* const New = Meshes.Find(Mesh);
	if (New == nullptr) { return RefuseMesh("SetObjectMesh", Mesh); }
	if (const FRTStatus Status = CheckMaterials(*New, Handles, Count); !Status) { return Status; }
	RemoveUsers(*Object);
	--Meshes.Find(Object->Mesh)->Users;
	++New->Users;
	Object->Mesh = Mesh;
	Object->Materials.assign(Handles, Handles + Count);
	AddUsers(*Object);
	FTicket Needs = New->Ticket;
	for (uint32_t Section = 0; Section < Count; ++Section) { Needs = std::max(Needs, Materials.Find(Handles[Section])->Ticket); }
	AddUpdate(FObjectMeshCommand{Objects.GetSlot(Handle), Meshes.GetSlot(Mesh), GetSlots(Object->Materials)}, Needs, Object->Ticket);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetObjectCastsShadow(ERTObjectHandle Handle, bool bCastsShadow)
{
	return SetMask("SetObjectCastsShadow", Handle, &FRTObjectTraits::bCastsShadow, bCastsShadow);
}

FRTStatus FSceneCalls::SetObjectVisible(ERTObjectHandle Handle, bool bVisible)
{
	return SetMask("SetObjectVisible", Handle, &FRTObjectTraits::bVisible, bVisible);
}

FRTStatus FSceneCalls::SetObjectChannels(ERTObjectHandle Handle, uint8_t Channels)
{
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectChannels", "object"); }
	Object->Traits.Channels = Channels;
	AddUpdate(FChannelsCommand{Objects.GetSlot(Handle), Channels}, 0, Object->Ticket);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetObjectToon(ERTObjectHandle Handle, const FRTModuleToon* Toon)
{
	const FRTStatus Status = CheckToon(Toon);
	std::lock_guard Lock(Mutex);
	FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("SetObjectToon", "object"); }
	if (!Status) { return Status; }
	Object->Toon = ToToonStyle(Toon);
	AddUpdate(FToonCommand{Objects.GetSlot(Handle), Object->Toon}, 0, Object->Ticket);
	return Status;
}

FRTStatus FSceneCalls::RemoveObject(ERTObjectHandle Handle)
{
	std::lock_guard Lock(Mutex);
	const FObject* const Object = Objects.Find(Handle);
	if (Object == nullptr) { return RefuseHandle("RemoveObject", "object"); }
	RemoveUsers(*Object);
	--Meshes.Find(Object->Mesh)->Users; // it cannot have been removed
	--ObjectCount;
	Objects.Remove(Handle);
	AddArrival(FRemoveObjectCommand{Objects.GetSlot(Handle)});
	return FRTStatus::Success();
}

// ---------------------------------------------------------------------------------------------------- lights

FRTStatus FSceneCalls::AddLight(const FRTModuleLight& Light, ERTLightHandle* Out)
{
	if (Out == nullptr) { return RefuseNull("AddLight", "Out"); }
	*Out = ERTLightHandle::None;
	if (const FRTStatus Status = CheckLight(Light); !Status) { return Status; }
	std::lock_guard Lock(Mutex);
	if (Light.Ies != ERTIesHandle::None && Profiles.Find(Light.Ies) == nullptr) { return RefuseHandle("AddLight", "profile"); }
	if (LightCount == FLightStore::MaxLights)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "AddLight: there are 2^23 lights, and no more have an index");
	}
	++LightCount;
	*Out = Lights.Add({});
	FLight& Mine = *Lights.Find(*Out);
	(void)SetProfile(Mine, Light.Ies);
	Mine.Ticket = AddArrival(FLightCommand{Lights.GetSlot(*Out), ToSceneLight(World, Light, *Out)});
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetLight(ERTLightHandle Handle, const FRTModuleLight& Light)
{
	const FRTStatus Status = CheckLight(Light);
	std::lock_guard Lock(Mutex);
	FLight* const Mine = Lights.Find(Handle);
	if (Mine == nullptr) { return RefuseHandle("SetLight", "light"); }
	if (!Status) { return Status; }
	if (Light.Ies != ERTIesHandle::None && Profiles.Find(Light.Ies) == nullptr) { return RefuseHandle("SetLight", "profile"); }
	const FTicket Needs = SetProfile(*Mine, Light.Ies);
	AddUpdate(FLightCommand{Lights.GetSlot(Handle), ToSceneLight(World, Light, Handle)}, Needs, Mine->Ticket);
	return Status;
}

FRTStatus FSceneCalls::RemoveLight(ERTLightHandle Handle)
{
	std::lock_guard Lock(Mutex);
	FLight* const Mine = Lights.Find(Handle);
	if (Mine == nullptr) { return RefuseHandle("RemoveLight", "light"); }
	(void)SetProfile(*Mine, ERTIesHandle::None);
	Lights.Remove(Handle);
	--LightCount;
	AddArrival(FLightCommand{Lights.GetSlot(Handle), std::nullopt});
	return FRTStatus::Success();
}

FSceneCalls::FTicket FSceneCalls::SetProfile(FLight& Light, ERTIesHandle Profile)
{
	if (FProfile* const Before = Profiles.Find(Light.Profile)) { --Before->Users; }
	Light.Profile = Profile;
	FProfile* const Now = Profiles.Find(Profile);
	if (Now == nullptr) { return 0; }
	++Now->Users;
	return Now->Ticket;
}

FRTStatus FSceneCalls::AddIesProfile(const FRTModuleIesProfile& Profile, ERTIesHandle* Out, FRTModuleIesInfo* Info)
{
	if (Out == nullptr) { return RefuseNull("AddIesProfile", "Out"); }
	*Out = ERTIesHandle::None;
	FPhotometry Table;
	if (const FRTStatus Status = ReadProfile(Profile, Table); !Status) { return Status; }
	auto Grid = std::make_shared<const FProfileGrid>(MakeProfileGrid(Table));
	if (Info != nullptr) { Info->Peak = Grid->Peak; }
	std::lock_guard Lock(Mutex);
	if (ProfileCount == LIGHT_PROFILES_MOST)
	{
		return FRTStatus::Error(ERTResult::Unsupported, "AddIesProfile: there are 65,535 profiles, and no more have a number");
	}
	++ProfileCount;
	*Out = Profiles.Add({Grid, 0, 0});
	Profiles.Find(*Out)->Ticket = AddArrival(FProfileCommand{Profiles.GetSlot(*Out), std::move(Grid)});
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::RemoveIesProfile(ERTIesHandle Handle)
{
	std::lock_guard Lock(Mutex);
	const FProfile* const Profile = Profiles.Find(Handle);
	if (Profile == nullptr) { return RefuseHandle("RemoveIesProfile", "profile"); }
	if (Profile->Users > 0)
	{
		return FRTStatus::Error(ERTResult::InvalidArgument, "RemoveIesProfile: %u lights have the profile", Profile->Users);
	}
	Profiles.Remove(Handle);
	--ProfileCount;
	AddArrival(FProfileCommand{Profiles.GetSlot(Handle), nullptr});
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetSun(const FRTModuleSun& Sun)
{
	if (const FRTStatus Status = CheckSun(Sun); !Status) { return Status; }
	FSunLight Light;
	Light.Direction = World.ToDirection(Sun.Direction);
	Light.Color = {Sun.Color[0], Sun.Color[1], Sun.Color[2]};
	Light.Irradiance = Sun.Irradiance;
	Light.AngularDiameter = Sun.AngularDiameter;
	Light.Channels = Sun.Channels;
	std::lock_guard Lock(Mutex);
	Updates.emplace_back(Light);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetSkyMap(const FRTModuleSkyMap* Map)
{
	FSkyMapCommand Command;
	FMaterialTextures New;
	if (Map != nullptr)
	{
		if (const FRTStatus Status = CheckSkyMap(*Map); !Status) { return Status; }
		Command.Map = World.ToSkyMap(*Map);
		New.Textures.emplace_back(Map->Texture);
		New.Samplers.emplace_back(Map->Sampler);
	}
	std::lock_guard Lock(Mutex);
	Command.Old = std::exchange(SkyTextures, std::move(New));
	Updates.emplace_back(std::move(Command));
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetSkyProgram(const FRTModuleSkyProgram* Program)
{
	FSkyProgramCommand Command;
	if (Program != nullptr)
	{
		if (const FRTStatus Status = CheckSkyProgram(*Program); !Status) { return Status; }
		Command.Program = World.ToSkyProgram(*Program);
	}
	std::lock_guard Lock(Mutex);
	Updates.emplace_back(Command);
	return FRTStatus::Success();
}

FRTStatus FSceneCalls::SetSky(const float Radiance[3])
{
	if (const FRTStatus Status = CheckSky(Radiance); !Status) { return Status; }
	std::lock_guard Lock(Mutex);
	Updates.emplace_back(FSkyCommand{{Radiance[0], Radiance[1], Radiance[2]}});
	return FRTStatus::Success();
}

} // namespace Lantern
