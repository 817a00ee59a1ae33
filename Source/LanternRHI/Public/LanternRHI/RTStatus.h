// What every call of the RHI stands on: results that are values, and objects that are counted. C++17, no Vulkan, no standard
// containers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace Lantern
{

/// Changes with every change of an interface or a description of the RHI. The plugin refuses another version with a message.
inline constexpr uint32_t RHIVersion = 4;

// ---------------------------------------------------------------------------------------------------- status

enum class ERTResult : int32_t
{
	Ok = 0,
	InvalidArgument, ///< found by the validation wrapper; backends assert instead
	OutOfHostMemory,
	OutOfDeviceMemory,
	OutOfDescriptors, ///< the bindless heap is full
	Unsupported,      ///< the driver or device cannot do this
	CompileFailed,    ///< the driver refused a shader or a pipeline
	Timeout,
	DeviceLost, ///< every later call returns this too; the device must be created anew
	IoError,
};

/// Result of a call that depends on the environment. Ok carries no message. The size is fixed, so that a status crosses an
/// ABI. A longer message is cut between two characters and ends in "...".
struct [[nodiscard]] FRTStatus
{
	static constexpr size_t MaxMessage = 508;

	ERTResult Code = ERTResult::Ok;
	char Message[MaxMessage] = {};

	bool IsOk() const { return Code == ERTResult::Ok; }
	explicit operator bool() const { return IsOk(); }

	static FRTStatus Success() { return {}; }
	/// Formats as printf. The message is valid UTF-8 without control characters, line breaks and tabs aside, whatever goes in.
	/// A name from outside still needs FRTShown (RTText.h), which lets no line break through.
	static FRTStatus Error(ERTResult InCode, const char* Format, ...)
#if defined(__GNUC__)
	    __attribute__((format(printf, 2, 3)))
#endif
	    ;
};

// ---------------------------------------------------------------------------------------------------- reference counting

/// Base of every RHI object. Thread-safe. An object starts with one reference, owned by whoever created it.
/// A command list keeps references to all that it recorded until the GPU has finished with it. The device destroys native
/// objects only after the last submission that may use them. Release() is therefore always safe for what is recorded by name.
/// What an unsubmitted list reaches only by address or bindless index must live until the list was submitted.
class IRTRefCounted
{
public:
	virtual uint32_t AddRef() = 0;
	virtual uint32_t Release() = 0;

protected:
	virtual ~IRTRefCounted() = default;
};

/// Intrusive pointer to an RHI object.
template <class T>
class TRTRef
{
public:
	TRTRef() = default;
	TRTRef(std::nullptr_t) {}
	/// Shares InObject: takes a reference of its own.
	explicit TRTRef(T* InObject) : Object(InObject)
	{
		if (Object) { Object->AddRef(); }
	}
	TRTRef(const TRTRef& Other) : TRTRef(Other.Object) {}
	TRTRef(TRTRef&& Other) noexcept : Object(Other.Object) { Other.Object = nullptr; }
	~TRTRef() { Reset(); }
	TRTRef& operator=(TRTRef Other) noexcept
	{
		T* Mine = Object;
		Object = Other.Object;
		Other.Object = Mine;
		return *this;
	}
	void Reset()
	{
		if (Object) { Object->Release(); }
		Object = nullptr;
	}
	/// For creation calls: releases what is held and returns the address that receives the new object.
	T** ReleaseAndGetAddress()
	{
		Reset();
		return &Object;
	}
	T* Get() const { return Object; }
	T* operator->() const { return Object; }
	T& operator*() const { return *Object; }
	explicit operator bool() const { return Object != nullptr; }
	friend bool operator==(const TRTRef& A, const TRTRef& B) { return A.Object == B.Object; }

private:
	T* Object = nullptr;
};

} // namespace Lantern
