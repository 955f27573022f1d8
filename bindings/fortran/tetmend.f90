! SPDX-License-Identifier: MIT
! tetmend for Fortran 2003: compile this file with your program, and link libtetmend.
!
!   use tetmend
!   type(tetmend_mesh) :: mesh
!   if (mesh%create() /= tetmend_ok) stop 'out of memory'
!   if (mesh%load('part.mesh') == tetmend_ok) then
!     if (mesh%set('schedule', 'thorough') == tetmend_ok) ...
!
! A type with procedures around <tetmend/tetmend.h>, which says what each of them does. Points and
! tets are numbered from 1. Functions give a status; what was wrong says last_error(). Two threads may
! work on two meshes at the same time.
module tetmend
  use, intrinsic :: iso_c_binding
  implicit none
  private

  ! Status
  integer(c_int), parameter, public :: tetmend_ok = 0, tetmend_wrong_input = 1, &
    tetmend_wrong_option = 2, tetmend_wrong_call = 3, tetmend_no_memory = 4, tetmend_failed = 5
  ! What data belong to
  integer(c_int), parameter, public :: tetmend_points = 0, tetmend_edges = 1, &
    tetmend_triangles = 2, tetmend_tets = 3
  ! Stages of a run, and why it ended
  integer(c_int), parameter, public :: tetmend_building = 0, tetmend_measuring = 1, &
    tetmend_improving = 2
  integer(c_int), parameter, public :: tetmend_finished = 0, tetmend_time_limit = 1, &
    tetmend_stopped = 2

  integer(c_int), parameter :: type_int32 = 0, type_double = 3

  type, bind(c), public :: tetmend_ruler
    real(c_double) :: worst, one_percent, mean
  end type

  type, bind(c), public :: tetmend_statistics
    integer(c_size_t) :: tets, vertices, boundary_triangles, inverted, flat
    real(c_double) :: volume, theta_min, theta_max, lambda, lambda_bands(5), q_worst, q_mean
    integer(c_size_t) :: n_bad
    real(c_double) :: q_aver
    integer(c_size_t) :: histogram(36)
    type(tetmend_ruler) :: rulers(11)
    real(c_double) :: shortest_edge
    integer(c_size_t) :: faces_above_70
    real(c_double) :: cg_steps, work
  end type

  type, bind(c), public :: tetmend_result
    integer(c_int) :: ending
    real(c_double) :: goal_min, goal_max
    integer(c_size_t) :: passes, attempts, accepted, touched_tets, protected_tets, &
      not_positive_before, not_positive_after
    integer(c_int64_t) :: surface_fingerprint
    real(c_double) :: volume_change, building, measuring, improving
  end type

  type, bind(c), public :: tetmend_progress
    integer(c_int) :: stage
    type(c_ptr) :: phase
    integer(c_int) :: round
    real(c_double) :: share
    integer(c_size_t) :: n_bad
  end type

  abstract interface
    ! Anything but 0 stops the run. Called by any thread of the run, never by two at once.
    function tetmend_progress_function(user, progress) bind(c) result(stops)
      import :: c_int, c_ptr, tetmend_progress
      type(c_ptr), value :: user
      type(tetmend_progress), intent(in) :: progress
      integer(c_int) :: stops
    end function
  end interface
  public :: tetmend_progress_function, tetmend_version

  ! A copy is the same mesh, not one more: destroy one of them.
  type, public :: tetmend_mesh
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    procedure, public :: create
    procedure, public :: destroy
    procedure, public :: last_error
    procedure, public :: set
    procedure, public :: check_options
    procedure, public :: reset_options
    procedure, public :: load
    procedure, public :: save
    procedure, public :: set_progress
    procedure, public :: improve
    procedure, public :: set_points
    procedure, public :: set_tets
    procedure, public :: set_triangles
    procedure, public :: set_edges
    procedure, public :: set_point_labels
    procedure, public :: set_required_vertices
    procedure, private :: set_real_data
    procedure, private :: set_integer_data
    procedure, private :: get_real_data
    procedure, private :: get_integer_data
    generic, public :: set_data => set_real_data, set_integer_data
    generic, public :: get_data => get_real_data, get_integer_data
    procedure, public :: set_group
    procedure, public :: group_count
    procedure, public :: get_group
    procedure, public :: count => count_of
    procedure, public :: get_points
    procedure, public :: get_tets
    procedure, public :: get_triangles
    procedure, public :: get_edges
    procedure, public :: get_point_labels
    procedure, public :: get_vertex_map
    procedure, public :: get_tet_map
    procedure, public :: measure
    procedure, public :: get_statistics
    procedure, public :: get_result
    procedure, public :: note_count
    procedure, public :: note
    procedure, public :: worse_count
    procedure, public :: worse
  end type

  interface
    function c_create() bind(c, name='tetmend_create') result(handle)
      import :: c_ptr
      type(c_ptr) :: handle
    end function
    subroutine c_destroy(handle) bind(c, name='tetmend_destroy')
      import :: c_ptr
      type(c_ptr), value :: handle
    end subroutine
    function c_last_error(handle) bind(c, name='tetmend_last_error') result(text)
      import :: c_ptr
      type(c_ptr), value :: handle
      type(c_ptr) :: text
    end function
    function c_refuse(handle, message) bind(c, name='tetmend_refuse') result(status)
      import :: c_ptr, c_char, c_int
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: message(*)
      integer(c_int) :: status
    end function
    function c_version() bind(c, name='tetmend_version') result(text)
      import :: c_ptr
      type(c_ptr) :: text
    end function
    function c_set(handle, name, value) bind(c, name='tetmend_set') result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: name(*), value(*)
      integer(c_int) :: status
    end function
    function c_check_options(handle) bind(c, name='tetmend_check_options') result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: handle
      integer(c_int) :: status
    end function
    function c_reset_options(handle) bind(c, name='tetmend_reset_options') result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: handle
      integer(c_int) :: status
    end function
    function c_set_first_number(handle, number) bind(c, name='tetmend_set_first_number') &
        result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: handle
      integer(c_int), value :: number
      integer(c_int) :: status
    end function
    function c_load(handle, file) bind(c, name='tetmend_load') result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: file(*)
      integer(c_int) :: status
    end function
    function c_save(handle, file) bind(c, name='tetmend_save') result(status)
      import :: c_ptr, c_int, c_char
      type(c_ptr), value :: handle
      character(kind=c_char), intent(in) :: file(*)
      integer(c_int) :: status
    end function
    function c_set_points(handle, xyz, n) bind(c, name='tetmend_set_points') result(status)
      import :: c_ptr, c_int, c_double, c_size_t
      type(c_ptr), value :: handle
      real(c_double), intent(in) :: xyz(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_set_tets(handle, tets, n, labels) bind(c, name='tetmend_set_tets') result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(in) :: tets(*)
      integer(c_size_t), value :: n
      type(c_ptr), value :: labels
      integer(c_int) :: status
    end function
    function c_set_triangles(handle, triangles, n, labels) bind(c, name='tetmend_set_triangles') &
        result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(in) :: triangles(*)
      integer(c_size_t), value :: n
      type(c_ptr), value :: labels
      integer(c_int) :: status
    end function
    function c_set_edges(handle, edges, n, labels) bind(c, name='tetmend_set_edges') &
        result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(in) :: edges(*)
      integer(c_size_t), value :: n
      type(c_ptr), value :: labels
      integer(c_int) :: status
    end function
    function c_set_point_labels(handle, labels) bind(c, name='tetmend_set_point_labels') &
        result(status)
      import :: c_ptr, c_int, c_int32_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(in) :: labels(*)
      integer(c_int) :: status
    end function
    function c_set_required_vertices(handle, vertices, n) &
        bind(c, name='tetmend_set_required_vertices') result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(in) :: vertices(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_set_data(handle, place, name, type, components, values) &
        bind(c, name='tetmend_set_data') result(status)
      import :: c_ptr, c_int, c_char, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: place
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int), value :: type
      integer(c_size_t), value :: components
      type(c_ptr), value :: values
      integer(c_int) :: status
    end function
    function c_count(handle, place) bind(c, name='tetmend_count') result(n)
      import :: c_ptr, c_int, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: place
      integer(c_size_t) :: n
    end function
    function c_get_points(handle, xyz, n) bind(c, name='tetmend_get_points') result(status)
      import :: c_ptr, c_int, c_double, c_size_t
      type(c_ptr), value :: handle
      real(c_double), intent(out) :: xyz(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_get_tets(handle, tets, labels, n) bind(c, name='tetmend_get_tets') result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(out) :: tets(*)
      integer(c_int32_t), intent(out) :: labels(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_get_triangles(handle, triangles, labels, n) bind(c, name='tetmend_get_triangles') &
        result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(out) :: triangles(*)
      integer(c_int32_t), intent(out) :: labels(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_get_edges(handle, edges, labels, n) bind(c, name='tetmend_get_edges') &
        result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(out) :: edges(*)
      integer(c_int32_t), intent(out) :: labels(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_get_point_labels(handle, labels, n) bind(c, name='tetmend_get_point_labels') &
        result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(out) :: labels(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_data_count(handle, place) bind(c, name='tetmend_data_count') result(n)
      import :: c_ptr, c_int, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: place
      integer(c_size_t) :: n
    end function
    function c_data_info(handle, place, i, name, type, components) &
        bind(c, name='tetmend_data_info') result(status)
      import :: c_ptr, c_int, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: place
      integer(c_size_t), value :: i
      type(c_ptr), intent(out) :: name
      integer(c_int), intent(out) :: type
      integer(c_size_t), intent(out) :: components
      integer(c_int) :: status
    end function
    function c_get_data(handle, place, name, type, values, n) bind(c, name='tetmend_get_data') &
        result(status)
      import :: c_ptr, c_int, c_char, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: place
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int), value :: type
      type(c_ptr), value :: values
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_set_group(handle, place, number, name, members, n) &
        bind(c, name='tetmend_set_group') result(status)
      import :: c_ptr, c_int, c_int32_t, c_char, c_size_t
      type(c_ptr), value :: handle
      integer(c_int), value :: place
      integer(c_int32_t), value :: number
      character(kind=c_char), intent(in) :: name(*)
      type(c_ptr), value :: members
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_group_count(handle) bind(c, name='tetmend_group_count') result(n)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t) :: n
    end function
    function c_group_info(handle, i, place, number, name, n) bind(c, name='tetmend_group_info') &
        result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: i
      integer(c_int), intent(out) :: place
      integer(c_int32_t), intent(out) :: number
      type(c_ptr), intent(out) :: name
      integer(c_size_t), intent(out) :: n
      integer(c_int) :: status
    end function
    function c_get_group(handle, i, members, n) bind(c, name='tetmend_get_group') result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: i
      integer(c_int32_t), intent(out) :: members(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_set_progress(handle, function, user) bind(c, name='tetmend_set_progress') &
        result(status)
      import :: c_ptr, c_funptr, c_int
      type(c_ptr), value :: handle
      type(c_funptr), value :: function
      type(c_ptr), value :: user
      integer(c_int) :: status
    end function
    function c_improve(handle) bind(c, name='tetmend_improve') result(status)
      import :: c_ptr, c_int
      type(c_ptr), value :: handle
      integer(c_int) :: status
    end function
    function c_get_vertex_map(handle, map, n) bind(c, name='tetmend_get_vertex_map') &
        result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(out) :: map(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_get_tet_map(handle, map, n) bind(c, name='tetmend_get_tet_map') result(status)
      import :: c_ptr, c_int, c_int32_t, c_size_t
      type(c_ptr), value :: handle
      integer(c_int32_t), intent(out) :: map(*)
      integer(c_size_t), value :: n
      integer(c_int) :: status
    end function
    function c_measure(handle, statistics) bind(c, name='tetmend_measure') result(status)
      import :: c_ptr, c_int, tetmend_statistics
      type(c_ptr), value :: handle
      type(tetmend_statistics), intent(out) :: statistics
      integer(c_int) :: status
    end function
    function c_get_statistics(handle, before, after) bind(c, name='tetmend_get_statistics') &
        result(status)
      import :: c_ptr, c_int, tetmend_statistics
      type(c_ptr), value :: handle
      type(tetmend_statistics), intent(out) :: before, after
      integer(c_int) :: status
    end function
    function c_get_result(handle, result) bind(c, name='tetmend_get_result') result(status)
      import :: c_ptr, c_int, tetmend_result
      type(c_ptr), value :: handle
      type(tetmend_result), intent(out) :: result
      integer(c_int) :: status
    end function
    function c_note_count(handle) bind(c, name='tetmend_note_count') result(n)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t) :: n
    end function
    function c_note(handle, i) bind(c, name='tetmend_note') result(text)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: i
      type(c_ptr) :: text
    end function
    function c_worse_count(handle) bind(c, name='tetmend_worse_count') result(n)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t) :: n
    end function
    function c_worse(handle, i) bind(c, name='tetmend_worse') result(text)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: handle
      integer(c_size_t), value :: i
      type(c_ptr) :: text
    end function
    function c_strlen(text) bind(c, name='strlen') result(n)
      import :: c_ptr, c_size_t
      type(c_ptr), value :: text
      integer(c_size_t) :: n
    end function
  end interface

contains

  ! A text of C.
  function to_fortran(text) result(made)
    type(c_ptr), intent(in) :: text
    character(len=:), allocatable :: made
    character(kind=c_char), pointer :: letters(:)
    integer :: i, n
    made = ''
    if (.not. c_associated(text)) return
    n = int(c_strlen(text))
    call c_f_pointer(text, letters, [n])
    made = repeat(' ', n)
    do i = 1, n
      made(i:i) = letters(i)
    end do
  end function

  ! Blanks at the end do not count.
  function to_c(text) result(made)
    character(len=*), intent(in) :: text
    character(kind=c_char) :: made(len_trim(text) + 1)
    integer :: i
    do i = 1, len_trim(text)
      made(i) = text(i:i)
    end do
    made(size(made)) = c_null_char
  end function

  function tetmend_version() result(text)
    character(len=:), allocatable :: text
    text = to_fortran(c_version())
  end function

  function create(self) result(status)
    class(tetmend_mesh), intent(inout) :: self
    integer(c_int) :: status
    call self%destroy()
    self%handle = c_create()
    status = tetmend_no_memory
    if (c_associated(self%handle)) status = c_set_first_number(self%handle, 1_c_int)
  end function

  subroutine destroy(self)
    class(tetmend_mesh), intent(inout) :: self
    call c_destroy(self%handle)
    self%handle = c_null_ptr
  end subroutine

  function last_error(self) result(text)
    class(tetmend_mesh), intent(in) :: self
    character(len=:), allocatable :: text
    text = to_fortran(c_last_error(self%handle))
  end function

  ! A shape as text: "(3, 8)".
  function shown(extents) result(text)
    integer, intent(in) :: extents(:)
    character(len=:), allocatable :: text
    integer :: i
    text = '('
    do i = 1, size(extents)
      if (i > 1) text = text // ', '
      text = text // number_text(extents(i))
    end do
    text = text // ')'
  end function

  function number_text(number) result(text)
    integer, intent(in) :: number
    character(len=:), allocatable :: text
    character(len=12) :: room
    write (room, '(i0)') number
    text = trim(room)
  end function

  ! What is wrong with an array becomes the last error.
  function refuse(self, name, extents, wanted) result(status)
    class(tetmend_mesh), intent(in) :: self
    character(len=*), intent(in) :: name, wanted
    integer, intent(in) :: extents(:)
    integer(c_int) :: status
    status = c_refuse(self%handle, to_c(name // ' has shape ' // shown(extents) // ', but ' // &
                                        wanted // ' is wanted'))
  end function

  function set(self, name, value) result(status)
    class(tetmend_mesh), intent(in) :: self
    character(len=*), intent(in) :: name, value
    integer(c_int) :: status
    status = c_set(self%handle, to_c(name), to_c(value))
  end function

  function check_options(self) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int) :: status
    status = c_check_options(self%handle)
  end function

  function reset_options(self) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int) :: status
    status = c_reset_options(self%handle)
  end function

  function load(self, file) result(status)
    class(tetmend_mesh), intent(in) :: self
    character(len=*), intent(in) :: file
    integer(c_int) :: status
    status = c_load(self%handle, to_c(file))
  end function

  function save(self, file) result(status)
    class(tetmend_mesh), intent(in) :: self
    character(len=*), intent(in) :: file
    integer(c_int) :: status
    status = c_save(self%handle, to_c(file))
  end function

  function set_progress(self, function) result(status)
    class(tetmend_mesh), intent(in) :: self
    procedure(tetmend_progress_function) :: function
    integer(c_int) :: status
    status = c_set_progress(self%handle, c_funloc(function), c_null_ptr)
  end function

  function improve(self) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int) :: status
    status = c_improve(self%handle)
  end function

  ! xyz(3, n)
  function set_points(self, xyz) result(status)
    class(tetmend_mesh), intent(in) :: self
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int) :: status
    if (size(xyz, 1) == 3) then
      status = c_set_points(self%handle, xyz, size(xyz, 2, c_size_t))
    else
      status = refuse(self, 'xyz', shape(xyz), '(3, n)')
    end if
  end function

  ! tets(4, n), labels(n)
  function set_tets(self, tets, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), intent(in) :: tets(:, :)
    integer(c_int32_t), intent(in), optional :: labels(:)
    integer(c_int32_t), allocatable, target :: copy(:)
    type(c_ptr) :: address
    integer(c_int) :: status
    status = check_shapes(self, 'tets', tets, 4, labels)
    if (status /= tetmend_ok) return
    address = c_null_ptr
    if (present(labels)) then
      allocate (copy(size(labels)))
      copy = labels
      if (size(copy) > 0) address = c_loc(copy)
    end if
    status = c_set_tets(self%handle, tets, size(tets, 2, c_size_t), address)
  end function

  ! triangles(3, n), labels(n)
  function set_triangles(self, triangles, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), intent(in) :: triangles(:, :)
    integer(c_int32_t), intent(in), optional :: labels(:)
    integer(c_int32_t), allocatable, target :: copy(:)
    type(c_ptr) :: address
    integer(c_int) :: status
    status = check_shapes(self, 'triangles', triangles, 3, labels)
    if (status /= tetmend_ok) return
    address = c_null_ptr
    if (present(labels)) then
      allocate (copy(size(labels)))
      copy = labels
      if (size(copy) > 0) address = c_loc(copy)
    end if
    status = c_set_triangles(self%handle, triangles, size(triangles, 2, c_size_t), address)
  end function

  ! edges(2, n), labels(n)
  function set_edges(self, edges, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), intent(in) :: edges(:, :)
    integer(c_int32_t), intent(in), optional :: labels(:)
    integer(c_int32_t), allocatable, target :: copy(:)
    type(c_ptr) :: address
    integer(c_int) :: status
    status = check_shapes(self, 'edges', edges, 2, labels)
    if (status /= tetmend_ok) return
    address = c_null_ptr
    if (present(labels)) then
      allocate (copy(size(labels)))
      copy = labels
      if (size(copy) > 0) address = c_loc(copy)
    end if
    status = c_set_edges(self%handle, edges, size(edges, 2, c_size_t), address)
  end function

  function check_shapes(self, name, elements, rows, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: elements(:, :)
    integer, intent(in) :: rows
    integer(c_int32_t), intent(in), optional :: labels(:)
    integer(c_int) :: status
    status = tetmend_ok
    if (size(elements, 1) /= rows) then
      status = refuse(self, name, shape(elements), '(' // number_text(rows) // ', n)')
    else if (present(labels)) then
      if (size(labels) /= size(elements, 2)) then
        status = refuse(self, 'labels of ' // name, shape(labels), shown([size(elements, 2)]))
      end if
    end if
  end function

  function set_point_labels(self, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), intent(in) :: labels(:)
    integer(c_int) :: status
    if (size(labels) == self%count(tetmend_points)) then
      status = c_set_point_labels(self%handle, labels)
    else
      status = refuse(self, 'labels of points', shape(labels), shown([self%count(tetmend_points)]))
    end if
  end function

  function set_required_vertices(self, vertices) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), intent(in) :: vertices(:)
    integer(c_int) :: status
    status = c_set_required_vertices(self%handle, vertices, size(vertices, kind=c_size_t))
  end function

  ! values(components, n)
  function set_real_data(self, place, name, values) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int), intent(in) :: place
    character(len=*), intent(in) :: name
    real(c_double), intent(in) :: values(:, :)
    real(c_double), allocatable, target :: copy(:, :)
    integer(c_int) :: status
    if (size(values, 2) /= self%count(place) .or. size(values) == 0) then
      status = refuse(self, 'data ' // trim(name), shape(values), &
                      '(components, ' // number_text(self%count(place)) // ')')
      return
    end if
    allocate (copy(size(values, 1), size(values, 2)))
    copy = values
    status = c_set_data(self%handle, place, to_c(name), type_double, size(values, 1, c_size_t), &
                        c_loc(copy))
  end function

  ! values(components, n)
  function set_integer_data(self, place, name, values) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int), intent(in) :: place
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in) :: values(:, :)
    integer(c_int32_t), allocatable, target :: copy(:, :)
    integer(c_int) :: status
    if (size(values, 2) /= self%count(place) .or. size(values) == 0) then
      status = refuse(self, 'data ' // trim(name), shape(values), &
                      '(components, ' // number_text(self%count(place)) // ')')
      return
    end if
    allocate (copy(size(values, 1), size(values, 2)))
    copy = values
    status = c_set_data(self%handle, place, to_c(name), type_int32, size(values, 1, c_size_t), &
                        c_loc(copy))
  end function

  function count_of(self, place) result(n)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int), intent(in) :: place
    integer :: n
    n = int(c_count(self%handle, place))
  end function

  ! xyz(3, n)
  function get_points(self, xyz) result(status)
    class(tetmend_mesh), intent(in) :: self
    real(c_double), allocatable, intent(out) :: xyz(:, :)
    integer(c_int) :: status
    allocate (xyz(3, self%count(tetmend_points)))
    status = c_get_points(self%handle, xyz, size(xyz, 2, c_size_t))
  end function

  ! tets(4, n), labels(n)
  function get_tets(self, tets, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), allocatable, intent(out) :: tets(:, :), labels(:)
    integer(c_int) :: status
    allocate (tets(4, self%count(tetmend_tets)), labels(self%count(tetmend_tets)))
    status = c_get_tets(self%handle, tets, labels, size(labels, kind=c_size_t))
  end function

  ! triangles(3, n), labels(n)
  function get_triangles(self, triangles, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), allocatable, intent(out) :: triangles(:, :), labels(:)
    integer(c_int) :: status
    allocate (triangles(3, self%count(tetmend_triangles)), labels(self%count(tetmend_triangles)))
    status = c_get_triangles(self%handle, triangles, labels, size(labels, kind=c_size_t))
  end function

  ! edges(2, n), labels(n)
  function get_edges(self, edges, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), allocatable, intent(out) :: edges(:, :), labels(:)
    integer(c_int) :: status
    allocate (edges(2, self%count(tetmend_edges)), labels(self%count(tetmend_edges)))
    status = c_get_edges(self%handle, edges, labels, size(labels, kind=c_size_t))
  end function

  function get_point_labels(self, labels) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), allocatable, intent(out) :: labels(:)
    integer(c_int) :: status
    allocate (labels(self%count(tetmend_points)))
    status = c_get_point_labels(self%handle, labels, size(labels, kind=c_size_t))
  end function

  ! Components of an array of data; 0 if there is none of this name.
  function components_of(self, place, name) result(components)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int), intent(in) :: place
    character(len=*), intent(in) :: name
    integer(c_size_t) :: components, i
    type(c_ptr) :: text
    integer(c_int) :: type
    do i = 0, c_data_count(self%handle, place) - 1
      if (c_data_info(self%handle, place, i, text, type, components) /= tetmend_ok) exit
      if (to_fortran(text) == name) return
    end do
    components = 0
  end function

  ! values(components, n)
  function get_real_data(self, place, name, values) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int), intent(in) :: place
    character(len=*), intent(in) :: name
    real(c_double), allocatable, target, intent(out) :: values(:, :)
    integer(c_int) :: status
    type(c_ptr) :: address
    allocate (values(components_of(self, place, name), self%count(place)))
    address = c_null_ptr
    if (size(values) > 0) address = c_loc(values)
    status = c_get_data(self%handle, place, to_c(name), type_double, address, &
                        size(values, kind=c_size_t))
  end function

  ! values(components, n)
  function get_integer_data(self, place, name, values) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int), intent(in) :: place
    character(len=*), intent(in) :: name
    integer(c_int32_t), allocatable, target, intent(out) :: values(:, :)
    integer(c_int) :: status
    type(c_ptr) :: address
    allocate (values(components_of(self, place, name), self%count(place)))
    address = c_null_ptr
    if (size(values) > 0) address = c_loc(values)
    status = c_get_data(self%handle, place, to_c(name), type_int32, address, &
                        size(values, kind=c_size_t))
  end function

  ! Without members: all with the label `number`.
  function set_group(self, place, number, name, members) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int), intent(in) :: place
    integer(c_int32_t), intent(in) :: number
    character(len=*), intent(in) :: name
    integer(c_int32_t), intent(in), optional :: members(:)
    integer(c_int32_t), allocatable, target :: copy(:)
    type(c_ptr) :: address
    integer(c_size_t) :: n
    integer(c_int) :: status
    address = c_null_ptr
    n = 0
    if (present(members)) then
      n = size(members, kind=c_size_t)
      allocate (copy(n))
      copy = members
      if (n > 0) address = c_loc(copy)
    end if
    status = c_set_group(self%handle, place, number, to_c(name), address, n)
  end function

  ! How many groups there are.
  function group_count(self) result(n)
    class(tetmend_mesh), intent(in) :: self
    integer :: n
    n = int(c_group_count(self%handle))
  end function

  ! Group i, from 1, as it was set: members(n).
  function get_group(self, i, place, number, name, members) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer, intent(in) :: i
    integer(c_int), intent(out) :: place
    integer(c_int32_t), intent(out) :: number
    character(len=:), allocatable, intent(out) :: name
    integer(c_int32_t), allocatable, intent(out) :: members(:)
    integer(c_size_t) :: n
    type(c_ptr) :: text
    integer(c_int) :: status
    status = c_group_info(self%handle, int(i - 1, c_size_t), place, number, text, n)
    if (status /= tetmend_ok) return
    name = to_fortran(text)
    allocate (members(n))
    status = c_get_group(self%handle, int(i - 1, c_size_t), members, n)
  end function

  ! map(n) with room for the points of the old mesh; 0: gone
  function get_vertex_map(self, map) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), intent(out) :: map(:)
    integer(c_int) :: status
    status = c_get_vertex_map(self%handle, map, size(map, kind=c_size_t))
  end function

  function get_tet_map(self, map) result(status)
    class(tetmend_mesh), intent(in) :: self
    integer(c_int32_t), intent(out) :: map(:)
    integer(c_int) :: status
    status = c_get_tet_map(self%handle, map, size(map, kind=c_size_t))
  end function

  function measure(self, statistics) result(status)
    class(tetmend_mesh), intent(in) :: self
    type(tetmend_statistics), intent(out) :: statistics
    integer(c_int) :: status
    status = c_measure(self%handle, statistics)
  end function

  function get_statistics(self, before, after) result(status)
    class(tetmend_mesh), intent(in) :: self
    type(tetmend_statistics), intent(out) :: before, after
    integer(c_int) :: status
    status = c_get_statistics(self%handle, before, after)
  end function

  function get_result(self, result) result(status)
    class(tetmend_mesh), intent(in) :: self
    type(tetmend_result), intent(out) :: result
    integer(c_int) :: status
    status = c_get_result(self%handle, result)
  end function

  function note_count(self) result(n)
    class(tetmend_mesh), intent(in) :: self
    integer :: n
    n = int(c_note_count(self%handle))
  end function

  ! Note i, from 1.
  function note(self, i) result(text)
    class(tetmend_mesh), intent(in) :: self
    integer, intent(in) :: i
    character(len=:), allocatable :: text
    text = to_fortran(c_note(self%handle, int(i - 1, c_size_t)))
  end function

  function worse_count(self) result(n)
    class(tetmend_mesh), intent(in) :: self
    integer :: n
    n = int(c_worse_count(self%handle))
  end function

  ! Figure i that is worse than before, from 1.
  function worse(self, i) result(text)
    class(tetmend_mesh), intent(in) :: self
    integer, intent(in) :: i
    character(len=:), allocatable :: text
    text = to_fortran(c_worse(self%handle, int(i - 1, c_size_t)))
  end function
end module
